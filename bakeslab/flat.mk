# The slab library (all that render/ may use), the rest of bakeslab, the
# program and its man pages.
SLAB_OBJECTS := $(patsubst %.c,$(B)/%.o,$(wildcard bakeslab/slab*.c))
BAKE_OBJECTS := $(patsubst %.c,$(B)/%.o,$(filter-out bakeslab/slab%.c bakeslab/main.c,$(wildcard bakeslab/*.c)))

$(B)/libslab.a: $(SLAB_OBJECTS)
$(B)/libbake.a: $(BAKE_OBJECTS)

$(B)/bakeslab: $(B)/bakeslab/main.o $(B)/libbake.a $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

# bakeslab.1, one page a subcommand (from --help, so that they cannot differ),
# and light-slab.5.
COMMANDS := $(patsubst bakeslab/cmd_%.c,%,$(wildcard bakeslab/cmd_*.c))
MAN_PAGES := $(B)/man/bakeslab.1 $(COMMANDS:%=$(B)/man/bakeslab-%.1) $(B)/man/light-slab.5

$(B)/man/%.1: bakeslab/man.sh $(B)/bakeslab | $(SETUP_FIRST)
	@mkdir -p $(@D)
	$(call say,MAN,$@)
	$(Q)sh bakeslab/man.sh $(B)/bakeslab $* $(VERSION) >$@

$(B)/man/%.5: bakeslab/%.5.scd | $(SETUP_FIRST)
	@mkdir -p $(@D)
	$(call say,MAN,$@)
	$(Q)SOURCE_DATE_EPOCH=$${SOURCE_DATE_EPOCH:-0} scdoc <$< >$@
