# The slab library (all that render/ may use), the rest of bakeslab, the
# program and its man pages.
SLAB_SOURCES := $(wildcard $(addprefix bakeslab/,base/*.c cli/*.c slab/*.c file/*.c))
BAKE_SOURCES := $(filter-out $(SLAB_SOURCES) bakeslab/preload/%,$(wildcard bakeslab/*/*.c bakeslab/*/*/*.c))
SLAB_OBJECTS := $(SLAB_SOURCES:%.c=$(B)/%.o)
BAKE_OBJECTS := $(BAKE_SOURCES:%.c=$(B)/%.o) $(patsubst %,$(B)/%.o,$(wildcard bakeslab/*/*/*.cc))

# The texts of some files as C arrays: X_inc of X.inc.in, gl_X_frag of X.frag.glsl.
define embed
	@mkdir -p $(@D)
	$(call say,EMBED,$@)
	$(Q)sh bakeslab/base/embed.sh '$(1)' $(filter-out %.sh,$^) >$@
endef

BAKE_OBJECTS += $(B)/bakeslab/include/templates.o
$(B)/bakeslab/include/templates.c: $(sort $(wildcard bakeslab/include/*/*.inc.in)) bakeslab/base/embed.sh | $(SETUP_FIRST)
	$(call embed)

# Also programs for others as they are: export_X of X.py.
BAKE_OBJECTS += $(B)/bakeslab/export/export_templates.o
$(B)/bakeslab/export/export_templates.c: $(sort $(wildcard bakeslab/export/*.in bakeslab/export/*.py)) bakeslab/base/embed.sh | $(SETUP_FIRST)
	$(call embed,export_)

$(B)/libslab.a: $(SLAB_OBJECTS)
$(B)/libbake.a: $(BAKE_OBJECTS)

$(BAKE_BIN): $(B)/bakeslab/main.o $(B)/libbake.a $(B)/libslab.a
	@mkdir -p $(@D)
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

# bakeslab.1, one page a subcommand (from --help, so that they cannot differ),
# and light-slab.5.
BAKE_PAGES := $(B)/man/bakeslab.1 $(patsubst bakeslab/cmd/cmd_%.c,$(B)/man/bakeslab-%.1,$(wildcard bakeslab/cmd/cmd_*.c))
MAN_PAGES := $(BAKE_PAGES) $(B)/man/light-slab.5

# Bakes on many machines: scripts that the programs' folder holds too, and what both of them read.
FARM_LIB := $(B)/lib/canned/farm.sh

$(FARM): $(B)/bin/%: bakeslab/farm/%.sh $(FARM_LIB)
	@mkdir -p $(@D)
	$(Q)install -m 755 $< $@

$(FARM_LIB): bakeslab/farm/farm.sh bakeslab/base/version.h
	@mkdir -p $(@D)
	$(Q)sed 's/@VERSION@/$(VERSION)/' $< >$@

FARM_PAGES := $(FARM:$(B)/bin/%=$(B)/man/%.1)
MAN_PAGES += $(FARM_PAGES)
$(FARM_PAGES): $(B)/man/%.1: bakeslab/cli/man.sh $(B)/bin/%
	$(man_page)

# For bash: the commands of both programs, their options and what these take, from --help too.
COMPLETIONS := $(BIN:$(B)/bin/%=$(B)/completions/%)

$(COMPLETIONS): $(B)/completions/%: bakeslab/cli/completion.sh $(B)/bin/%
	@mkdir -p $(@D)
	$(call say,BASH,$@)
	$(Q)sh $^ >$@

DATE = $(or $(SOURCE_DATE_EPOCH),$(shell git log -1 --format=%ct 2>/dev/null || date +%s))

# A page of section 1, of the program that it depends on.
define man_page
	@mkdir -p $(@D)
	$(call say,MAN,$@)
	$(Q)SOURCE_DATE_EPOCH=$(DATE) sh bakeslab/cli/man.sh $(filter $(BIN) $(FARM),$^) $* $(VERSION) >$@
endef

$(BAKE_PAGES): $(B)/man/%.1: bakeslab/cli/man.sh $(BAKE_BIN)
	$(man_page)

$(B)/man/%.5: bakeslab/file/%.5.scd
	@mkdir -p $(@D)
	$(call say,MAN,$@)
	$(Q)SOURCE_DATE_EPOCH=$(DATE) scdoc <$< >$@

# Found by the program relative to itself, built or installed alike.
READS := $(B)/lib/canned/reads.so
$(READS): bakeslab/preload/reads.c bakeslab/preload/polls.c bakeslab/preload/matt.c bakeslab/preload/matt.h bakeslab/base/sdl_scan.c bakeslab/base/sdl_scan.h | $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC,$@)
	$(Q)$(CC) -O2 -D_GNU_SOURCE $(WARN) -Ibakeslab -fPIC -shared $(filter %.c,$^) -ldl -o $@

# The only program that loads OpenImageIO.
IMAGE := $(B)/lib/canned/bakeslab-image
IMAGE_OBJECTS := $(patsubst %,$(B)/%.o,$(wildcard bakeslab/image/*.cc))
$(IMAGE_OBJECTS): EXTRA_CXXFLAGS = $(IMAGE_CFLAGS)
$(IMAGE): $(IMAGE_OBJECTS)
	@mkdir -p $(@D)
	$(call say,LINK,$@)
	$(Q)$(CXX) $(ALL_LDFLAGS) $^ $(IMAGE_LIBS) $(LDLIBS) -o $@

$(B)/share/canned/include-pov:
	@mkdir -p $(@D)
	$(Q)ln -sfn $(CURDIR)/include-pov $@

$(BAKE_BIN): | $(READS) $(IMAGE) $(B)/share/canned/include-pov
