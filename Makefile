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
prefix ?= /usr/local
SETUP ?= yes

ifeq ($(origin CC),default)
CC := gcc
endif
ifeq ($(origin CXX),default)
CXX := $(if $(findstring clang,$(CC)),clang++,g++)
endif
ifeq ($(filter release debug sanitize thread fuzz,$(config)),)
$(error config=$(config) is none of release, debug, sanitize, thread and fuzz)
endif
# All cores unless told otherwise, but once: a make below this one shares them.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 1)
endif

# ---- Flags. pkg-config is asked when the first recipe needs it, not while the
# Makefile is read: by then `setup` may just have installed the libraries.
CFLAGS_release  := -O2 -g
CFLAGS_debug    := -O0 -g
CFLAGS_sanitize := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
CFLAGS_thread   := -O1 -g -fsanitize=thread -fno-omit-frame-pointer
CFLAGS_fuzz     := $(CFLAGS_sanitize) -fsanitize=fuzzer-no-link
WARN_BOTH := -Wall -Wextra -Wshadow -Wconversion -Wvla
WARN := $(WARN_BOTH) -Wstrict-prototypes
PACKAGES_USED := libtiff-4 OpenEXR jansson libxxhash
PKG_CFLAGS = $(eval PKG_CFLAGS := $(shell pkg-config --cflags $(PACKAGES_USED) 2>/dev/null))$(PKG_CFLAGS)
PKG_LIBS = $(eval PKG_LIBS := $(shell pkg-config --libs $(PACKAGES_USED) 2>/dev/null))$(PKG_LIBS)
# What only renderslab uses. Embree 3 has no pkg-config file.
RENDER_USED := assimp libpng epoxy egl glfw3
RENDER_CFLAGS = $(eval RENDER_CFLAGS := -Irender $(shell pkg-config --cflags $(RENDER_USED) 2>/dev/null))$(RENDER_CFLAGS)
RENDER_LIBS = $(eval RENDER_LIBS := -lembree3 $(shell pkg-config --libs $(RENDER_USED) 2>/dev/null))$(RENDER_LIBS)
# What only bakeslab-image uses.
IMAGE_USED := OpenImageIO
IMAGE_CFLAGS = $(eval IMAGE_CFLAGS := $(shell pkg-config --cflags $(IMAGE_USED) 2>/dev/null))$(IMAGE_CFLAGS)
IMAGE_LIBS = $(eval IMAGE_LIBS := $(shell pkg-config --libs $(IMAGE_USED) 2>/dev/null))$(IMAGE_LIBS)

ALL_CFLAGS = -std=c17 -D_GNU_SOURCE $(WARN) -ffp-contract=off $(CFLAGS_$(config)) -Ibakeslab $(PKG_CFLAGS) $(CFLAGS)
# C++ is for shims around libraries that are C++ (CGAL, OpenImageIO), whose headers are system
# headers here: their warnings are not ours.
ALL_CXXFLAGS = -std=c++17 -D_GNU_SOURCE $(WARN_BOTH) -ffp-contract=off $(CFLAGS_$(config)) -Ibakeslab -Irender $(CFLAGS)
ALL_LDFLAGS = -Wl,--as-needed $(CFLAGS_$(config)) $(CFLAGS) $(LDFLAGS)
ALL_LDLIBS = $(PKG_LIBS) -lstdc++ -lpthread -lm $(LDLIBS)

Q := $(if $(V),,@)
say = $(if $(V),@:,@printf '%-5s %s\n' $(1) $(2))
quote = '$(subst ','\'',$(1))'

.DEFAULT_GOAL := all
.SECONDARY:
.DELETE_ON_ERROR:
.PHONY: FORCE all help setup man install uninstall clean

# ---- Set-up: the Debian packages that the goals on the command line need.
PACKAGES_build := $(if $(findstring clang,$(CC)),clang,gcc g++) libc6-dev make pkg-config \
  libtiff-dev libopenexr-dev libjansson-dev libxxhash-dev \
  libcgal-dev libopenimageio-dev libembree-dev libassimp-dev libpng-dev libepoxy-dev libegl-dev libglfw3-dev
PACKAGES_demo := povray povray-includes openimageio-tools
PACKAGES_plot := gnuplot-nox
PACKAGES_lamps := povray povray-includes jq
PACKAGES_man  := help2man scdoc
PACKAGES_test := $(PACKAGES_demo) $(PACKAGES_plot) $(PACKAGES_lamps) $(PACKAGES_man) libcmocka-dev libgmp-dev bats bubblewrap \
  povray-examples libtiff-tools groff chromium xvfb xauth xdotool
PACKAGES_fuzz := clang libclang-rt-14-dev
PACKAGES_lint := $(PACKAGES_test) git g++ clang-format clang-tidy cppcheck shellcheck
goals_need = $(if $(filter $(1),$(MAKECMDGOALS)),$(2))
PACKAGES := $(sort $(PACKAGES_build) \
  $(call goals_need,demo bench figures tradeoff,$(PACKAGES_demo)) \
  $(call goals_need,tradeoff,$(PACKAGES_plot)) \
  $(call goals_need,lamps,$(PACKAGES_lamps)) \
  $(call goals_need,setup test stability sanitize,$(PACKAGES_test)) \
  $(call goals_need,fuzz fuzz_all sanitize,$(PACKAGES_fuzz)) \
  $(call goals_need,man install,$(PACKAGES_man)) \
  $(call goals_need,lint,$(PACKAGES_lint)))

# Compiling waits for it where the goal is one that sets up by itself.
SETUP_FIRST := $(call goals_need,setup demo lamps figures tradeoff test stability bench lint sanitize fuzz fuzz_all man install,setup)

all: $(BIN) ## build the programs (the default)
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

# Installs what dpkg does not know yet; asks neither apt nor the network
# when nothing is missing.
setup: ## install the Debian packages that are missing (SETUP=no: never)
ifneq ($(SETUP),no)
	@if command -v apt-get >/dev/null && command -v dpkg-query >/dev/null; then \
	  have=$$(dpkg-query -W -f='$${db:Status-Status} $${Package}\n' $(PACKAGES) 2>/dev/null | sed -n 's/^installed //p'); \
	  missing=; for p in $(PACKAGES); do printf '%s\n' "$$have" | grep -qxF "$$p" || missing="$$missing $$p"; done; \
	  if [ -n "$$missing" ]; then \
	    echo "make setup: apt installs$$missing"; \
	    root=; if [ "$$(id -u)" != 0 ]; then root=sudo; command -v sudo >/dev/null || { \
	      echo "make setup: neither root nor sudo: as root, apt-get install$$missing" >&2; exit 1; }; fi; \
	    mkdir -p $(B); log=$(B)/setup.log; echo "make setup: this can take minutes; apt's words go to $$log"; \
	    { $$root env DEBIAN_FRONTEND=noninteractive apt-get update -qq && \
	      $$root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing; } \
	      </dev/null >$$log 2>&1 || { tail -n 20 $$log; echo "make setup: apt could not install$$missing" >&2; exit 1; }; \
	  fi; \
	elif ! pkg-config --exists $(PACKAGES_USED) $(RENDER_USED) $(IMAGE_USED) 2>/dev/null; then \
	  echo 'make setup: no apt here: install a C and a C++ compiler, pkg-config, libtiff, OpenEXR 3.1 or newer, jansson, xxhash, CGAL, OpenImageIO, Embree 3, assimp, libpng, GLFW, POV-Ray 3.7 and oiiotool (make lamps: jq; tests: cmocka, GMP, bats, gnuplot, help2man, scdoc, tiffcp, groff, chromium, Xvfb, xdotool) by other means' >&2; exit 1; \
	fi
endif

# ---- Compiling. The flags are a file, so that other flags rebuild.
$(B)/flags: FORCE | $(SETUP_FIRST)
	@mkdir -p $(@D)
	@missing=; for p in $(PACKAGES_USED) $(RENDER_USED) $(IMAGE_USED); do pkg-config --exists $$p 2>/dev/null || missing="$$missing $$p"; done; \
	  [ -z "$$missing" ] || { echo "Not here (pkg-config names):$$missing: run \`make setup\`." >&2; exit 1; }
	@pkg-config --atleast-version=3.1 OpenEXR || { \
	  echo "OpenEXR $$(pkg-config --modversion OpenEXR) is here, but 3.1 or newer is needed, as Debian 12 has." >&2; exit 1; }
	@echo '#include <embree3/rtcore.h>' | $(CC) $(ALL_CFLAGS) -E -x c - >$@.new 2>&1 || { \
	  echo 'The library Embree 3 (embree3/rtcore.h) is not here: run `make setup`.' >&2; exit 1; }
	@echo '#include <CGAL/version.h>' | $(CXX) $(ALL_CXXFLAGS) -E -x c++ - >$@.new 2>&1 || { \
	  echo 'The library CGAL (CGAL/version.h), or the compiler $(CXX), is not here: run `make setup`.' >&2; exit 1; }
	@printf '%s\n' $(call quote,$(CC) $(ALL_CFLAGS) / $(RENDER_CFLAGS) / $(CXX) $(ALL_CXXFLAGS) $(IMAGE_CFLAGS) / $(ALL_LDFLAGS) $(RENDER_LIBS) $(IMAGE_LIBS) $(ALL_LDLIBS)) >$@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

$(B)/%.o: %.c $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)$(CC) $(ALL_CFLAGS) $(EXTRA_CFLAGS) -MMD -MP -c $< -o $@

$(B)/%.o: %.cc $(B)/flags
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
LIB_FILES := $(READS)
MAKE_FILES := bakeslab/canned.mk
DOC_FILES := README.md LICENSE CITATION.cff $(LAMP_FILES)
dest := $(DESTDIR)$(prefix)

install: all $(LIB_FILES) $(MAN_PAGES) ## install below DESTDIR and prefix
	$(Q)for f in $(BIN); do install -D -m 755 $$f $(dest)/bin/$${f##*/} || exit 1; done
	$(Q)for f in $(DATA_FILES); do \
	  if [ -x $$f ]; then mode=755; else mode=644; fi; install -D -m $$mode $$f $(dest)/share/canned/$$f || exit 1; done
	$(Q)for f in $(MAKE_FILES); do install -D -m 644 $$f $(dest)/share/canned/$${f##*/} || exit 1; done
	$(Q)install -D -m 755 $(IMAGE) $(dest)/lib/canned/$(notdir $(IMAGE))
	$(Q)for f in $(LIB_FILES); do install -D -m 644 $$f $(dest)/lib/canned/$${f##*/} || exit 1; done
	$(Q)for f in $(DOC_FILES); do install -D -m 644 $$f $(dest)/share/doc/canned/$$f || exit 1; done
	$(Q)for f in $(MAN_PAGES); do install -D -m 644 $$f $(dest)/share/man/man$${f##*.}/$${f##*/} || exit 1; done
	@echo 'installed bin/bakeslab, bin/renderslab, lib/canned, share/canned, share/man and share/doc/canned below $(dest)'

uninstall: ## remove what install put there
	$(Q)rm -f $(BIN:$(B)/%=$(dest)/%) $(foreach f,$(notdir $(MAN_PAGES)),$(dest)/share/man/man$(patsubst .%,%,$(suffix $(f)))/$(f))
	$(Q)rm -rf $(dest)/share/canned $(dest)/share/doc/canned $(dest)/lib/canned

clean: ## remove everything that was built
	$(Q)rm -rf build

-include $(shell find $(B) -name "*.d" 2>/dev/null)
