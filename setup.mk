# Set-up: what the goals on the command line need of Debian, and the first of two makes. A goal
# that sets up by itself is made by a second make, which begins when set-up has ended. The first
# one reads no other rule: nothing is generated, compiled or asked of pkg-config before.
SETUP ?= yes
SETS_UP := setup demo lamps gallery figures tradeoff simulate peers engines test farm-test bare stability bench lint sanitize fuzz fuzz_all man install deb

# Where there is no Debian, pkg-config is asked for these.
PACKAGES_USED := libtiff-4 OpenEXR jansson libxxhash
RENDER_USED := libpng epoxy egl glfw3
IMAGE_USED := OpenImageIO

PACKAGES_build := $(if $(findstring clang,$(CC)),clang,gcc g++) libc6-dev make pkg-config \
  libtiff-dev libopenexr-dev libjansson-dev libxxhash-dev \
  libcgal-dev libopenimageio-dev libembree-dev libpng-dev libepoxy-dev libegl-dev libglfw3-dev
# What the programs run.
PACKAGES_run := povray povray-includes
PACKAGES_demo := $(PACKAGES_run) openimageio-tools
PACKAGES_plot := gnuplot-nox
PACKAGES_peers := python3-venv libedit2 libz3-4
# Libraries of Blender's module, too, which it does not bring along.
PACKAGES_engines := $(PACKAGES_peers) libxi6 libxxf86vm1 libxfixes3 libxrender1 libxkbcommon0 libsm6 libgl1
PACKAGES_lamps := $(PACKAGES_run) jq
PACKAGES_man  := help2man scdoc
PACKAGES_bare := git debootstrap
PACKAGES_test := $(PACKAGES_demo) $(PACKAGES_plot) $(PACKAGES_lamps) $(PACKAGES_man) libcmocka-dev libgmp-dev bats bubblewrap \
  povray-examples libtiff-tools groff procps chromium xvfb xauth xdotool python3-minimal
PACKAGES_farm := $(PACKAGES_lamps) bats slurmctld slurmd slurm-client munge parallel openssh-server openssh-client rsync faketime
PACKAGES_deb := dpkg-dev
PACKAGES_fuzz := clang libclang-rt-14-dev
PACKAGES_lint := $(PACKAGES_test) git g++ clang-format clang-tidy cppcheck shellcheck
goals_need = $(if $(filter $(1),$(MAKECMDGOALS)),$(2))
PACKAGES := $(sort $(if $(filter-out bare,$(MAKECMDGOALS)),$(PACKAGES_build)) \
  $(call goals_need,demo bench figures tradeoff peers,$(PACKAGES_demo)) \
  $(call goals_need,tradeoff peers simulate,$(PACKAGES_plot)) \
  $(call goals_need,peers,$(PACKAGES_peers)) \
  $(call goals_need,engines,$(PACKAGES_engines)) \
  $(call goals_need,lamps gallery,$(PACKAGES_lamps)) \
  $(call goals_need,setup test engines stability sanitize,$(PACKAGES_test)) \
  $(call goals_need,setup bare,$(PACKAGES_bare)) \
  $(call goals_need,fuzz fuzz_all sanitize,$(PACKAGES_fuzz)) \
  $(call goals_need,man install deb,$(PACKAGES_man)) \
  $(call goals_need,farm-test,$(PACKAGES_farm)) \
  $(call goals_need,deb,$(PACKAGES_deb)) \
  $(call goals_need,lint,$(PACKAGES_lint)))

setup: ## install the Debian packages that are missing (SETUP=no: never)
ifneq ($(SETUP),no)
	@LIBRARIES='$(PACKAGES_USED) $(RENDER_USED) $(IMAGE_USED)' sh setup.sh $(B)/setup.log $(PACKAGES)

SETUP_FIRST := $(filter $(SETS_UP),$(MAKECMDGOALS))
endif

ifdef SETUP_FIRST
GOALS_THEN := $(filter-out setup,$(MAKECMDGOALS))
.PHONY: then $(GOALS_THEN)
$(GOALS_THEN): then
then: setup
	+@$(MAKE) --no-print-directory SETUP=no $(GOALS_THEN)
endif
