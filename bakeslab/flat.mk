# The slab library (all that render/ may use), the rest of bakeslab, the program.
SLAB_OBJECTS := $(patsubst %.c,$(B)/%.o,$(wildcard bakeslab/slab*.c))
BAKE_OBJECTS := $(patsubst %.c,$(B)/%.o,$(filter-out bakeslab/slab%.c bakeslab/main.c,$(wildcard bakeslab/*.c)))

$(B)/libslab.a: $(SLAB_OBJECTS)
	$(AR) rcs $@ $^

$(B)/libbake.a: $(BAKE_OBJECTS)
	$(AR) rcs $@ $^

$(B)/bakeslab: $(B)/bakeslab/main.o $(B)/libbake.a $(B)/libslab.a
	$(CC) $(ALL_CFLAGS) $^ $(ALL_LDLIBS) -o $@
