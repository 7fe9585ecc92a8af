# What is given to break the programs. tests/fuzz/fuzz_*.c and .cc are fuzzers, each with its seeds
# in tests/fuzz/seeds/: the seeds run in `make test` as fuzz/tiff and so on; `make fuzz` builds the
# fuzzers with libFuzzer and gives each its part of FUZZ_SECONDS; they are linked as C++, which
# CGAL's checked types ask for.
FUZZ_SOURCES := $(sort $(wildcard tests/fuzz/fuzz_*.c tests/fuzz/fuzz_*.cc))
FUZZ_NAMES := $(patsubst tests/fuzz/fuzz_%,%,$(basename $(FUZZ_SOURCES)))
FUZZ_SECONDS ?= 60
TEST_NAMES += $(FUZZ_NAMES:%=fuzz/%)

FUZZ_RENDER := faces gltf mtl obj ply receivers words
fuzz_libs = $(if $(filter $(FUZZ_RENDER),$(1)),$(RENDER_LIBS)) $(ALL_LDLIBS)
FUZZ_IMAGE_OBJECTS := $(patsubst %,$(B)/bakeslab/image/%.cc.o,says colours)
fuzz_object = $(patsubst %.c,$(B)/%.o,$(patsubst %.cc,$(B)/%.cc.o,$(filter tests/fuzz/fuzz_$(1).%,$(FUZZ_SOURCES))))
fuzz_tested = $(if $(filter image,$(1)),$(FUZZ_IMAGE_OBJECTS)) $(if $(filter $(FUZZ_RENDER),$(1)),$(B)/librender.a,$(B)/libbake.a) $(B)/libslab.a

define fuzz_programs
$(B)/tests/fuzz/corpus_$(1): $(call fuzz_object,$(1)) $(B)/tests/fuzz/fuzz.o $(B)/tests/fuzz/corpus.o $(call fuzz_tested,$(1))
	$$(call say,LINK,$$@)
	$$(Q)$$(CC) $$(ALL_LDFLAGS) $$^ $$(call fuzz_libs,$(1)) -o $$@

$(B)/tests/fuzz/$(1).log: $(B)/tests/fuzz/corpus_$(1) FORCE
	@$$(TEST_ENV) sh tests/run.sh $$@ $$< $$(sort $$(wildcard tests/fuzz/seeds/$(1)/*))

$(B)/tests/fuzz/fuzz_$(1): $(call fuzz_object,$(1)) $(B)/tests/fuzz/fuzz.o $(call fuzz_tested,$(1))
	$$(call say,LINK,$$@)
	$$(Q)$$(CXX) $$(ALL_LDFLAGS) -fsanitize=fuzzer $$^ $$(call fuzz_libs,$(1)) -o $$@
endef
$(foreach f,$(FUZZ_NAMES),$(eval $(call fuzz_programs,$(f))))

.PHONY: fuzz fuzz_all
fuzz: ## let libFuzzer (clang) change the seeds for FUZZ_SECONDS (60) in all
	+@$(MAKE) --no-print-directory config=fuzz CC=clang fuzz_all

fuzz_all: $(FUZZ_NAMES:%=$(B)/tests/fuzz/fuzz_%)
	@$(TEST_ENV) FUZZ_SECONDS=$(FUZZ_SECONDS) sh tests/fuzz/run.sh $(FUZZ_NAMES)

# Slab files changed at random, MUTANTS of them; all are read again with each run.
MUTANTS ?= 10000
TEST_NAMES += faults/mutants

$(B)/tests/faults/mutants: $(B)/tests/faults/mutants.o $(ORACLE) $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

$(B)/tests/faults/mutants.log: $(B)/tests/faults/mutants FORCE
	@$(TEST_ENV) sh tests/run.sh $@ $< 1 $(MUTANTS) $(sort $(wildcard tests/fuzz/seeds/tiff/* tests/fuzz/seeds/exr/*))

# How many faults of a kind, and kills; `make sanitize` asks for more.
FAULTS ?= 4
KILLS ?= 10

# Memory and disks that fail: a program that runs every command with each of FAULTS faults of
# a kind, what it preloads, and a stand-in for POV-Ray.
FAULTS_PROGRAMS := $(B)/tests/faults/faults $(B)/tests/faults/fake_povray $(B)/tests/faults/nomem.so
TEST_NAMES += faults/bakeslab faults/renderslab

$(B)/tests/faults/faults: $(B)/tests/faults/faults.o $(B)/tests/faults/left.o $(B)/tests/faults/supervise.o $(B)/libbake.a $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

$(B)/tests/faults/fake_povray: $(B)/tests/faults/fake_povray.o $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

$(B)/tests/faults/nomem.so: tests/faults/nomem.c | $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC,$@)
	$(Q)$(CC) -O1 -g -D_GNU_SOURCE $(WARN) -fPIC -shared $< -o $@

$(B)/tests/faults/bakeslab.log $(B)/tests/faults/renderslab.log: $(B)/tests/faults/%.log: $(FAULTS_PROGRAMS) $(BIN) FORCE
	@$(TEST_ENV) TOOLS=$(abspath $(B)/tests/faults) sh tests/run.sh $@ bash -c '. tests/needs.bash && needs xvfb-run && exec xvfb-run -a -s "-screen 0 800x600x24 -noreset" "$$@"' _ $< $*

$(B)/tests/faults/interrupted.log $(B)/tests/bake/shared.log: $(B)/tests/faults/fake_povray

# A driver's memory that its globals hold looks lost once the driver is unloaded: for
# render/viewer none is.
$(B)/tests/faults/keep.so: tests/faults/keep.c | $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC,$@)
	$(Q)$(CC) -O1 -g -D_GNU_SOURCE $(WARN) -fPIC -shared $< -o $@

ifeq ($(config),sanitize)
$(B)/tests/render/viewer.log: $(B)/tests/faults/keep.so
endif

# All of it, at length: every test under the address and undefined behaviour sanitizers, but for
# those that build programs of their own (without sanitizer); what uses threads under the thread
# sanitizer; the fuzzers; and more of every fault.
SANITIZE_TESTS ?= $(filter-out house/install house/makefile house/setup,$(TEST_NAMES))
# Threads are those of bakeslab/base/tiles.c: whoever gathers light, or makes levels and trees for that, and
# ray files of bakeslab. gcc 12's thread sanitizer dies where addresses are too random: setarch.
THREAD_TESTS ?= render/test_tiles unit/test_ray_estimate render/test_visible render/test_cut render/test_limits render/test_gl render/image render/tradeoff numerics/%
sanitize_step = $(MAKE) --no-print-directory TEST_TIMEOUT=1800

.PHONY: sanitize
sanitize: ## run the tests with sanitizers, the fuzzers, and many faults; tells how many
	@mkdir -p build && touch build/sanitize.start
	+@$(sanitize_step) config=sanitize T='$(SANITIZE_TESTS)' test
	+@$$(setarch -R true 2>/dev/null && echo setarch -R) $(sanitize_step) config=thread T='$(THREAD_TESTS)' test
	+@$(MAKE) --no-print-directory fuzz
	+@$(sanitize_step) MUTANTS=100000 FAULTS=40 KILLS=50 T='faults/%' test
	@sh tests/faults/figures.sh build/sanitize.start build/sanitize build/thread build/fuzz $(B)
