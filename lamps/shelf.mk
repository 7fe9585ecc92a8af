# shelf.mk - slabs, include files and pictures of LAMPS (scripts, photometric and ray files;
# absolute paths) in the working folder. `make lamps` runs it there and makes a page of what came
# out. It sets:
#
#   LAMPS, BAKE, RENDER    lamps; the programs
#   SHELF_FLAGS            options of `bakeslab bake` in place of those in each script's header
HERE := $(dir $(lastword $(MAKEFILE_LIST)))
STEP := $(HERE)shelf.sh
NAMES := $(basename $(notdir $(LAMPS)))
BAKED := $(basename $(notdir $(filter %.pov,$(LAMPS))))

.PHONY: all FORCE
.SECONDARY:
.DELETE_ON_ERROR:
all: $(NAMES:%=%.inc) $(BAKED:%=%.png) $(NAMES:%=%.far.png)

# As many bakes as make runs jobs; here, of one process each.
BAKESLAB = $(BAKE)
CANNED_BAKE_FLAGS = $(if $(filter local,$(CANNED_LAUNCH)),-j 1) $(file <$*.flags)
CANNED_LAUNCHER = $(dir $(BAKE))canned-$(CANNED_LAUNCH)
canned_run = @$(STEP) try $* $(1)
include $(HERE)../bakeslab/canned.mk
vpath %.pov $(sort $(dir $(LAMPS)))
vpath %.ies $(sort $(dir $(LAMPS)))
vpath %.rays $(sort $(dir $(LAMPS)))

# Other options bake anew.
$(BAKED:%=%.tif): %.tif: %.flags
$(BAKED:%=%.flags): %.flags: %.pov FORCE
	@$(STEP) flags $< $(call canned_quote,$(SHELF_FLAGS)) >$@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

# The slab knows what else the script reads.
$(BAKED:%=%.png): %.png: %.pov %.tif
	@$(STEP) preview $* $< $(HERE)../include-pov

$(NAMES:%=%.far.png): %.far.png: %.tif $(HERE)shelf_room.jq
	@$(STEP) rooms $* $(BAKE) $(RENDER)
