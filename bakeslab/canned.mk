# canned.mk - lamps for your own Makefile: `include` this file, and let scenes depend on
# desk_lamp.inc or desk_lamp.tif where there is a desk_lamp.pov, .ies, .ldt, .tm25ray or .rays.
#
#   %.tif: %.pov    bakeslab bake: a lamp script to a light slab; again when the script or
#                   any file that it read last time has changed
#   %.tif: %.ies    bakeslab import: a photometric file (%.ldt, too) or a ray file (%.tm25ray, and
#                   %.rays: text) to a light slab
#   %.inc: %.tif    bakeslab include: a light slab to an include file and its image
#
# Variables, on the command line, in a Makefile, or for one target:
#
#   BAKESLAB               the program
#   CANNED_BAKE_FLAGS      desk_lamp.tif: CANNED_BAKE_FLAGS = --uv 32x32 --rays 64
#   CANNED_IMPORT_FLAGS    downlight.tif: CANNED_IMPORT_FLAGS = --turn 90
#   CANNED_INCLUDE_FLAGS   desk_lamp.inc: CANNED_INCLUDE_FLAGS = --lights 8
#   CANNED_DEPENDS         the folder for what make is to know of files read
#   CANNED_LAUNCH          where lamps are baked: local; slurm, on a cluster (canned-slurm); or
#                          parallel, on machines that ssh reaches (canned-parallel)
#   CANNED_LAUNCH_FLAGS    CANNED_LAUNCH_FLAGS = --workers 32
#
# Other flags alone rebuild nothing. A bake that is interrupted goes on when make runs again;
# one that fails leaves the old slab, or none. Bakes use all processors by themselves: with many
# lamps, `make -j` and CANNED_BAKE_FLAGS = -j 1 are faster. A script that includes what make has
# yet to build must be told to depend on it. With CANNED_LAUNCH other than local, `make -j` sends
# off as many lamps at once.
BAKESLAB ?= bakeslab
CANNED_BAKE_FLAGS ?=
CANNED_IMPORT_FLAGS ?=
CANNED_INCLUDE_FLAGS ?=
CANNED_DEPENDS ?= .canned
CANNED_LAUNCH ?= local
CANNED_LAUNCH_FLAGS ?=
CANNED_LAUNCHER ?= canned-$(CANNED_LAUNCH)
ifeq ($(filter local slurm parallel,$(CANNED_LAUNCH)),)
$(error CANNED_LAUNCH=$(CANNED_LAUNCH) is none of local, slurm and parallel)
endif
canned_launch = $(if $(filter local,$(CANNED_LAUNCH)),,$(CANNED_LAUNCHER) $(CANNED_LAUNCH_FLAGS) -- )

canned_blank := $() $()
canned_quote = '$(subst ','\'',$(1))'
# A file of one folder for a target in any: + stands before what is not the name's own.
canned_depend = $(CANNED_DEPENDS)/$(subst /,+-,$(subst +,++,$@)).d

%.tif: %.pov
	@mkdir -p $(call canned_quote,$(CANNED_DEPENDS))
	$(call canned_run,bake) $(canned_launch)$(BAKESLAB) bake $(CANNED_BAKE_FLAGS) --depend $(call canned_quote,$(canned_depend)) -o $(call canned_quote,$@) $(call canned_quote,$<)

define canned_import
	$(call canned_run,import) $(BAKESLAB) import $(CANNED_IMPORT_FLAGS) -o $(call canned_quote,$@) $(call canned_quote,$<)
endef
%.tif: %.ies
	$(canned_import)
%.tif: %.ldt
	$(canned_import)
%.tif: %.tm25ray
	$(canned_import)
%.tif: %.rays
	$(canned_import)

%.inc: %.tif
	$(call canned_run,include) $(BAKESLAB) include $(CANNED_INCLUDE_FLAGS) -o $(call canned_quote,$@) $(call canned_quote,$<)

# Slabs on the way to an include file are kept.
.PRECIOUS: %.tif

# The rules read here must not choose what a bare `make` builds.
canned_goal := $(.DEFAULT_GOAL)
-include $(subst $(canned_blank),\ ,$(CANNED_DEPENDS))/*.d
.DEFAULT_GOAL := $(canned_goal)
