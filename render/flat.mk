# The reference renderer: its library, the program and its man pages.
RENDER_OBJECTS := $(patsubst %.c,$(B)/%.o,$(filter-out render/main.c,$(wildcard render/*.c)))

$(RENDER_OBJECTS) $(B)/render/main.o: EXTRA_CFLAGS = $(RENDER_CFLAGS)

$(B)/librender.a: $(RENDER_OBJECTS)

$(RENDER_BIN): $(B)/render/main.o $(B)/librender.a $(B)/libslab.a
	@mkdir -p $(@D)
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(RENDER_LIBS) $(ALL_LDLIBS) -o $@

RENDER_PAGES := $(B)/man/renderslab.1 $(patsubst render/cmd_%.c,$(B)/man/renderslab-%.1,$(wildcard render/cmd_*.c))
MAN_PAGES += $(RENDER_PAGES)

$(RENDER_PAGES): $(B)/man/%.1: bakeslab/man.sh $(RENDER_BIN) | $(SETUP_FIRST)
	$(man_page)
