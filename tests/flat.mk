# Tests: tests/*/test_*.c are cmocka programs, tests/**/*.bats run the program
# as a user would. Other C files beside a test_*.c are linked with each test of
# that folder. A test is named by its path without suffix: unit/test_slab.
# Those in tests/render and tests/numerics link what render/ may use, all others what bakeslab/ is;
# all link tests/oracle, which shares no code with either.
TEST_JOBS ?= $(shell nproc 2>/dev/null || echo 1)
TEST_TIMEOUT ?= 540
T := %

TEST_SOURCES := $(sort $(wildcard tests/*/test_*.c))
TEST_HELPERS := $(filter-out $(TEST_SOURCES),$(wildcard tests/*.c tests/*/*.c))
FARM_BATS := $(sort $(wildcard tests/farm/*.bats))
TEST_BATS := $(filter-out $(FARM_BATS),$(sort $(wildcard tests/*/*.bats tests/*/*/*.bats)))
TEST_NAMES := $(TEST_SOURCES:tests/%.c=%) $(TEST_BATS:tests/%.bats=%)
ORACLE := $(B)/tests/oracle.a
ORACLE_LIBS := -lgmp
$(ORACLE): $(patsubst %.c,$(B)/%.o,$(wildcard tests/oracle/*.c)) $(patsubst %,$(B)/%.o,$(wildcard tests/oracle/*.cc))
$(B)/tests/oracle/exact.cc.o: EXTRA_CXXFLAGS = -Itests

include tests/robust.mk
# Long ones first, so that no core is idle at the end.
TEST_LONG := $(filter bake/% chain/% house/%,$(TEST_NAMES))
TEST_CHOSEN := $(filter $(T),$(TEST_LONG) $(filter-out $(TEST_LONG),$(TEST_NAMES)))
TEST_LOGS := $(TEST_CHOSEN:%=$(B)/tests/%.log)

# Where `make engines` or `make peers` has installed other renderers, tests/export asks them.
ENGINES := $(abspath build/peers)
engine_there = $(if $(wildcard $(ENGINES)/$(2)),$(1)=$(wildcard $(ENGINES)/$(2))$(3))
ENGINE_RADIANCE = venv/lib/python3*/site-packages/pyradiance
ENGINE_ENV = $(call engine_there,MITSUBA_PYTHON,venv/bin/python) $(call engine_there,BLENDER_PYTHON,bpy/bin/python) \
  $(call engine_there,DRJIT_LIBLLVM_PATH,debian/usr/lib/x86_64-linux-gnu/libLLVM-19.so) \
  $(call engine_there,PATH,$(ENGINE_RADIANCE)/bin,:$$PATH) $(call engine_there,RAYPATH,$(ENGINE_RADIANCE)/lib,:.)

TEST_ENV = BAKESLAB=$(abspath $(BAKE_BIN)) RENDERSLAB=$(abspath $(RENDER_BIN)) CANNED_INCLUDE=$(abspath include-pov) BUILD=$(abspath $(B)) \
  CONFIG=$(config) FAULTS=$(FAULTS) KILLS=$(KILLS) TEST_JOBS=$(TEST_JOBS) TEST_TIMEOUT=$(TEST_TIMEOUT) \
  $(ENGINE_ENV) CMOCKA_MESSAGE_OUTPUT=TAP UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=suppressions=$(abspath tests/thread.supp):allocator_may_return_null=1 ASAN_OPTIONS=allocator_may_return_null=1:verify_asan_link_order=0 LC_ALL=C.UTF-8

.PHONY: test bench lint

# Programs find bakeslab-image relative to themselves, those of tests too.
$(B)/tests/lib: | $(IMAGE)
	@mkdir -p $(@D) && ln -sfn ../lib $@
$(TEST_LOGS): | $(B)/tests/lib $(FARM)

test: $(TEST_LOGS) ## run the tests
	$(if $(TEST_CHOSEN),,$(error T=$(T) names no test; there are: $(TEST_NAMES)))
	@sh tests/summary.sh $(TEST_LOGS)

# One after the other, since each uses all processors.
FARM_LOG := $(B)/tests/farm.log

.PHONY: farm-test
farm-test: $(BIN) $(FARM) $(B)/tests/faults/fake_povray ## bake by Slurm on four nodes, and by GNU parallel over ssh, all on this machine
	@mkdir -p $(B)/tests
	@$(TEST_ENV) TEST_TIMEOUT=3600 sh tests/run.sh $(FARM_LOG) bats --tap $(FARM_BATS)
	@sed -n 's/^# \(.* times the rays of one process .*\)/\1/p' $(FARM_LOG)
	@sh tests/summary.sh $(FARM_LOG)

# BARE: goals, and options of make for each of them: BARE="-j1 demo".
BARE ?= demo test

.PHONY: bare
bare: ## make demo and test (BARE: other goals) on a bare Debian 12, as a new user does; for root
	@bash tests/bare.sh build/bare.log $(BARE)

# Tools of the benchmarks and of `make tradeoff`; the demo's pictures are among what is measured.
BENCH_FLOOR := $(B)/tests/bench/floor
BENCH_SUM := $(B)/tests/bench/sum

$(BENCH_FLOOR): $(B)/tests/bench/floor.o $(B)/tests/bench/lit.o $(B)/tests/bench/lamp.o $(ORACLE) $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

$(BENCH_SUM): $(B)/tests/bench/sum.o $(B)/tests/bench/roofline.o $(ORACLE) $(B)/librender.a $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(RENDER_LIBS) $(ALL_LDLIBS) -o $@

BENCH_FRAMES := $(B)/tests/bench/frames

$(BENCH_FRAMES): $(B)/tests/bench/frames.o $(B)/librender.a $(B)/libslab.a | $(B)/tests/lib
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(RENDER_LIBS) $(ALL_LDLIBS) -o $@

BENCH_RAYS := $(B)/tests/bench/rays $(B)/tests/bench/peak

$(BENCH_RAYS): $(B)/tests/bench/%: $(B)/tests/bench/%.o $(ORACLE)
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

BENCH_ESTIMATE := $(B)/tests/bench/estimate $(B)/tests/bench/claims

$(BENCH_ESTIMATE): $(B)/tests/bench/%: $(B)/tests/bench/%.o $(ORACLE) $(B)/libbake.a $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

BENCH_SLAB_RAYS := $(B)/tests/bench/slab_rays

$(BENCH_SLAB_RAYS): $(B)/tests/bench/slab_rays.o $(ORACLE) $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

BENCH_CELL_ERROR := $(B)/tests/bench/cell_error

$(BENCH_CELL_ERROR): $(B)/tests/bench/cell_error.o $(ORACLE) $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

BENCH_EXPORT := $(patsubst %,$(B)/tests/export/test_%,pages radiance light)

TRADEOFF_LAMPS := $(B)/tests/tradeoff/lamps

$(TRADEOFF_LAMPS): $(B)/tests/tradeoff/lamps.o $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

SIMULATE := $(B)/tests/simulate/simulate

$(SIMULATE): $(patsubst %,$(B)/tests/simulate/%.o,simulate farm costs) $(B)/libbake.a $(B)/libslab.a
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(ALL_LDLIBS) -o $@

.PHONY: simulate
simulate: $(SIMULATE) ## simulate bakes that 1 to 1024 workers share, and plot how long they take
	@mkdir -p build/simulate
	@tests/simulate/run.sh $(SIMULATE) build/simulate

.PHONY: tradeoff
tradeoff: $(BIN) $(BENCH_FLOOR) $(TRADEOFF_LAMPS) ## measure what accuracy costs in time, and plot it
	@mkdir -p build/tradeoff
	@$(TEST_ENV) BUILD=$(abspath build/tradeoff) LAMPS=$(abspath $(TRADEOFF_LAMPS)) FLOOR=$(abspath $(BENCH_FLOOR)) tests/tradeoff/run.sh

# In a scratch environment below build/peers, from PyPI and Debian: needs the network once.
.PHONY: peers
peers: $(BIN) ## measure beside Mitsuba, Radiance and POV-Ray what a picture of two lamps costs
	@mkdir -p build/peers
	@$(TEST_ENV) BUILD=$(abspath build/peers) ENGINES=$(ENGINES) tests/peers/run.sh

# In the same scratch environment.
.PHONY: elsewhere
elsewhere: $(BIN) ## light a room by one slab in POV-Ray, renderslab, Cycles, Radiance and Mitsuba, and compare the pictures
	@mkdir -p build/elsewhere
	@$(TEST_ENV) BUILD=$(abspath build/elsewhere) ENGINES=$(ENGINES) tests/elsewhere/run.sh

# In the same scratch environment. Radiance and Mitsuba alone are 90 MB to load instead of 450.
ENGINES_OF := radiance mitsuba llvm blender

.PHONY: engines
engines: $(BIN) ## install Radiance, Mitsuba and Blender's bpy for tests (ENGINES_OF: some), and run those of exports with them
	@ENGINES=$(ENGINES) bash -c '. tests/peers/engines.bash; engines_install $(ENGINES_OF)'
	@$(MAKE) --no-print-directory SETUP=no test T='$(if $(filter command%,$(origin T)),$(T),export/%)'
	@sed -nE 's/^# (.*: (rays|irradiance) by (rtrace|Mitsuba|Cycles).*): /  \1  /p' $(B)/tests/export/*.log

bench: $(BIN) $(B)/tests/faults/fake_povray $(B)/tests/chain/test_photometric $(B)/tests/unit/test_photometry_slab $(BENCH_FLOOR) $(BENCH_SUM) $(BENCH_FRAMES) $(BENCH_RAYS) $(BENCH_ESTIMATE) $(BENCH_SLAB_RAYS) $(BENCH_CELL_ERROR) $(BENCH_EXPORT) $(TRADEOFF_LAMPS) $(DEMO)/canned.exr $(DEMO)/full.exr $(DEMO)/renderslab.exr ## measure, and print the tables of tests/RESULTS.md
	@mkdir -p build/bench
	@for b in $(filter $(T:%=tests/%.sh),$(wildcard tests/bench/*.sh)); do [ -x "$$b" ] || continue; \
	  $(TEST_ENV) BUILD=$(abspath build/bench) TESTS=$(abspath $(B)/tests) TOOLS=$(abspath $(B)/tests/bench) LAMPS=$(abspath $(TRADEOFF_LAMPS)) DEMO=$(abspath $(DEMO)) "$$b" || exit 1; done

# EFFORT: seeds of each row, in proportion; CASE: one row and seed again, with all numbers.
# Rows of POV-Ray's side are called pov-.
NUMERICS := $(B)/tests/numerics/test_numerics
HARD := $(B)/tests/chain/test_hard
EFFORT ?= 8

.PHONY: stability
stability: $(NUMERICS) $(HARD) $(BIN) ## sweep hard cases of the sums and of POV-Ray; CASE='ROW SEED' repeats one
	@mkdir -p build/stability
	$(if $(filter pov-%,$(CASE)),,@$(NUMERICS) $(if $(CASE),$(CASE),$(EFFORT) $(TEST_JOBS) build/stability/index.html build/stability/growth.txt))
	$(if $(CASE),,@tests/numerics/growth.sh build/stability/growth.txt build/stability/growth.png)
	$(if $(filter-out pov-%,$(firstword $(CASE))),,@$(TEST_ENV) $(HARD) $(if $(CASE),$(CASE),$(EFFORT) $(TEST_JOBS) build/stability/povray.html))

lint: $(B)/flags ## check formatting, static analysis and house rules
	@FLAGS=$(call quote,$(ALL_CFLAGS) $(RENDER_CFLAGS)) CXXFLAGS=$(call quote,$(ALL_CXXFLAGS) $(IMAGE_CFLAGS)) JOBS=$(TEST_JOBS) bash tests/lint/lint.sh

$(TEST_SOURCES:%.c=$(B)/%.o) $(TEST_HELPERS:%.c=$(B)/%.o): EXTRA_CFLAGS = -Itests $(RENDER_CFLAGS)
# The machine's rate of multiply-adds is that of fused ones.
$(B)/tests/bench/roofline.o: EXTRA_CFLAGS += -ffp-contract=fast

TEST_RENDERER := tests/render/% tests/numerics/%
test_tested = $(B)/$(if $(filter $(TEST_RENDERER),$(1)),librender.a,libbake.a) $(B)/libslab.a
# What else it is linked with: tests/numerics uses the helpers of tests/render, too.
test_helpers = $(filter tests/testing.c $(dir $(1))% $(if $(filter tests/numerics/%,$(1)),tests/render/%),$(TEST_HELPERS))
test_libs = -lcmocka $(ORACLE_LIBS) $(if $(filter $(TEST_RENDERER),$(1)),$(RENDER_LIBS)) $(ALL_LDLIBS)

define test_program
$(B)/$(1:.c=): $(B)/$(1:.c=.o) $(patsubst %.c,$(B)/%.o,$(call test_helpers,$(1))) $(ORACLE) $(call test_tested,$(1))
	$$(call say,LINK,$$@)
	$$(Q)$$(CC) $$(ALL_LDFLAGS) $$^ $$(call test_libs,$(1)) -o $$@

$(B)/$(1:.c=.log): $(B)/$(1:.c=) $(BIN) FORCE
	@$$(TEST_ENV) sh tests/run.sh $$@ $$<
endef
$(foreach t,$(TEST_SOURCES),$(eval $(call test_program,$(t))))

$(B)/tests/unit/test_slab_accuracy: $(B)/tests/bench/lamp.o
$(B)/tests/unit/test_polls: $(B)/bakeslab/preload/polls.o

$(TEST_BATS:%.bats=$(B)/%.log): $(B)/%.log: %.bats $(BIN) FORCE
	@mkdir -p $(@D)
	@$(TEST_ENV) sh tests/run.sh $@ bats --tap $<
