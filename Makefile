# Canned light sources: one dependency graph. `make help` lists the targets.
# Each folder adds its own lines through flat.mk; nothing is built outside
# $(B). A command line may set config, CC, CFLAGS, LDFLAGS, prefix, DESTDIR,
# SETUP=no, V=1 (show every command) and T (see `make help`).

VERSION := $(shell sed -n 's,^.define CANNED_VERSION "\(.*\)",\1,p' bakeslab/base/version.h)
config ?= release
B := build/$(config)
V :=
BAKE_BIN := $(B)/bin/bakeslab
RENDER_BIN := $(B)/bin/renderslab
BIN := $(BAKE_BIN) $(RENDER_BIN)
FARM := $(B)/bin/canned-slurm $(B)/bin/canned-parallel
prefix ?= /usr/local

ifeq ($(origin CC),default)
CC := gcc
endif
ifeq ($(origin CXX),default)
CXX := $(if $(findstring clang,$(CC)),clang++,g++)
endif
ifeq ($(filter release debug sanitize thread fuzz,$(config)),)
$(error config=$(config) is none of release, debug, sanitize, thread and fuzz)
endif
# Two jobs a core unless told otherwise, since half of a test's time POV-Ray sleeps; but once: a
# make below this one shares them.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(shell echo $$((2 * $$(nproc 2>/dev/null || echo 1))))
endif

Q := $(if $(V),,@)
say = $(if $(V),@:,@printf '%-5s %s\n' $(1) $(2))
quote = '$(subst ','\'',$(1))'

.DEFAULT_GOAL := all
.SECONDARY:
.DELETE_ON_ERROR:
.PHONY: FORCE all help setup man install uninstall deb clean

include setup.mk
# All that follows is read when set-up has ended.
ifndef SETUP_FIRST

# ---- Flags.
CFLAGS_release  := -O2 -g
CFLAGS_debug    := -O0 -g
CFLAGS_sanitize := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
CFLAGS_thread   := -O1 -g -fsanitize=thread -fno-omit-frame-pointer
CFLAGS_fuzz     := $(CFLAGS_sanitize) -fsanitize=fuzzer-no-link
WARN_BOTH := -Wall -Wextra -Wshadow -Wconversion -Wvla
WARN := $(WARN_BOTH) -Wstrict-prototypes
PKG_CFLAGS := $(shell pkg-config --cflags $(PACKAGES_USED) 2>/dev/null)
PKG_LIBS := $(shell pkg-config --libs $(PACKAGES_USED) 2>/dev/null)
# What only renderslab uses. Embree 3 has no pkg-config file.
RENDER_CFLAGS := -Irender $(shell pkg-config --cflags $(RENDER_USED) 2>/dev/null)
RENDER_LIBS := -lembree3 $(shell pkg-config --libs $(RENDER_USED) 2>/dev/null)
# What only bakeslab-image uses.
IMAGE_CFLAGS := $(shell pkg-config --cflags $(IMAGE_USED) 2>/dev/null)
IMAGE_LIBS := $(shell pkg-config --libs $(IMAGE_USED) libtiff-4 2>/dev/null)

ALL_CFLAGS = -std=c17 -D_GNU_SOURCE $(WARN) -ffp-contract=off $(CFLAGS_$(config)) -Ibakeslab $(PKG_CFLAGS) $(CFLAGS)
# C++ is for shims around libraries that are C++ (CGAL, OpenImageIO), whose headers are system
# headers here: their warnings are not ours.
ALL_CXXFLAGS = -std=c++17 -D_GNU_SOURCE $(WARN_BOTH) -ffp-contract=off $(CFLAGS_$(config)) -Ibakeslab -Irender $(CFLAGS)
ALL_LDFLAGS = -Wl,--as-needed $(CFLAGS_$(config)) $(CFLAGS) $(LDFLAGS)
ALL_LDLIBS = $(PKG_LIBS) -lstdc++ -lpthread -lm $(LDLIBS)

all: $(BIN) $(FARM) ## build the programs (the default)
	@:

include bakeslab/flat.mk
include lamps/flat.mk
include include-pov/flat.mk
include render/flat.mk
include tests/flat.mk

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)
	@echo
	@echo 'config=release|debug|sanitize|thread|fuzz  CC=clang  prefix=$(prefix)  DESTDIR=  SETUP=no  V=1'
	@echo 'make test T=unit/test_slab runs one test; T="cli/% unit/%" runs two folders'

# ---- Compiling. The flags are a file, so that other flags rebuild.
$(B)/flags: FORCE
	@mkdir -p $(@D)
	@echo '#include <stdlib.h>' | $(CC) -x c -fsyntax-only - >$@.new 2>&1 || { \
	  echo 'The C compiler $(CC), or the C library, is not here: run `make setup`.' >&2; exit 1; }
	@echo '#include <cstdlib>' | $(CXX) -x c++ -fsyntax-only - >$@.new 2>&1 || { \
	  echo 'The C++ compiler $(CXX), or its library, is not here: run `make setup`.' >&2; exit 1; }
	@missing=; for p in $(PACKAGES_USED) $(RENDER_USED) $(IMAGE_USED); do pkg-config --exists $$p 2>/dev/null || missing="$$missing $$p"; done; \
	  [ -z "$$missing" ] || { echo "Not here (pkg-config names):$$missing: run \`make setup\`." >&2; exit 1; }
	@pkg-config --atleast-version=3.1 OpenEXR || { \
	  echo "OpenEXR $$(pkg-config --modversion OpenEXR) is here, but 3.1 or newer is needed, as Debian 12 has." >&2; exit 1; }
	@echo '#include <embree3/rtcore.h>' | $(CC) $(ALL_CFLAGS) -E -x c - >$@.new 2>&1 || { \
	  echo 'The library Embree 3 (embree3/rtcore.h) is not here: run `make setup`.' >&2; exit 1; }
	@echo '#include <CGAL/version.h>' | $(CXX) $(ALL_CXXFLAGS) -E -x c++ - >$@.new 2>&1 || { \
	  echo 'The library CGAL (CGAL/version.h) is not here: run `make setup`.' >&2; exit 1; }
	@printf '%s\n' $(call quote,$(CC) $(ALL_CFLAGS) / $(RENDER_CFLAGS) / $(CXX) $(ALL_CXXFLAGS) $(IMAGE_CFLAGS) / $(ALL_LDFLAGS) $(RENDER_LIBS) $(IMAGE_LIBS) $(ALL_LDLIBS)) >$@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

$(B)/%.o: %.c $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)$(CC) $(ALL_CFLAGS) $(EXTRA_CFLAGS) -MMD -MP -c $< -o $@

# C that was made from other texts.
$(B)/%.o: $(B)/%.c $(B)/flags
	$(call say,CC,$<)
	$(Q)$(CC) $(ALL_CFLAGS) $(EXTRA_CFLAGS) -c $< -o $@

$(B)/%.cc.o: %.cc $(B)/flags
	@mkdir -p $(@D)
	$(call say,CXX,$<)
	$(Q)$(CXX) $(ALL_CXXFLAGS) $(EXTRA_CXXFLAGS) -MMD -MP -c $< -o $@

$(B)/%.a:
	$(call say,AR,$@)
	$(Q)rm -f $@ && $(AR) rcs $@ $^

man: $(MAN_PAGES) ## write the man pages
	@:

# ---- Installing.
DATA_FILES := $(POV_FILES)
LIB_FILES := $(READS) $(FARM_LIB)
SHARED_FILES := bakeslab/canned.mk bakeslab/export/canned_lights.py
DOC_FILES := README.md LICENSE CITATION.cff $(LAMP_FILES)
dest := $(DESTDIR)$(prefix)

install: all $(LIB_FILES) $(MAN_PAGES) $(COMPLETIONS) ## install below DESTDIR and prefix
	$(Q)for f in $(BIN) $(FARM); do install -D -m 755 $$f $(dest)/bin/$${f##*/} || exit 1; done
	$(Q)for f in $(DATA_FILES); do \
	  if [ -x $$f ]; then mode=755; else mode=644; fi; install -D -m $$mode $$f $(dest)/share/canned/$$f || exit 1; done
	$(Q)for f in $(SHARED_FILES); do install -D -m 644 $$f $(dest)/share/canned/$${f##*/} || exit 1; done
	$(Q)install -D -m 755 $(IMAGE) $(dest)/lib/canned/$(notdir $(IMAGE))
	$(Q)for f in $(LIB_FILES); do install -D -m 644 $$f $(dest)/lib/canned/$${f##*/} || exit 1; done
	$(Q)for f in $(DOC_FILES); do install -D -m 644 $$f $(dest)/share/doc/canned/$$f || exit 1; done
	$(Q)ln -sfn ../../canned/include-pov $(dest)/share/doc/canned/include-pov # README's links
	$(Q)for f in $(MAN_PAGES); do install -D -m 644 $$f $(dest)/share/man/man$${f##*.}/$${f##*/} || exit 1; done
	$(Q)for f in $(COMPLETIONS); do install -D -m 644 $$f $(dest)/share/bash-completion/completions/$${f##*/} || exit 1; done
	@echo 'installed bin/bakeslab, bin/renderslab, bin/canned-slurm, bin/canned-parallel, lib/canned, share/canned, share/man, share/bash-completion and share/doc/canned below $(dest)'

uninstall: ## remove what install put there
	$(Q)rm -f $(patsubst $(B)/%,$(dest)/%,$(BIN) $(FARM)) $(COMPLETIONS:$(B)/%=$(dest)/share/bash-completion/%) $(foreach f,$(notdir $(MAN_PAGES)),$(dest)/share/man/man$(patsubst .%,%,$(suffix $(f)))/$(f))
	$(Q)rm -rf $(dest)/share/canned $(dest)/share/doc/canned $(dest)/lib/canned

DEB = $(B)/canned_$(VERSION)_$(shell dpkg --print-architecture).deb
deb: all ## make a Debian package: all that a machine needs to bake
	@rm -rf $(B)/deb
	+@$(MAKE) --no-print-directory SETUP=no install DESTDIR=$(abspath $(B)/deb) prefix=/usr >/dev/null
	@sh deb.sh $(B)/deb $(VERSION) $(DATE) $(DEB) $(PACKAGES_run)
	@rm -rf $(B)/deb
	@echo 'made $(DEB)'

clean: ## remove everything that was built
	$(Q)rm -rf build

-include $(shell find $(B) -name "*.d" 2>/dev/null)

endif
