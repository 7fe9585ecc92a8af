# The reference renderer: its library, the program and its man pages.
RENDER_OBJECTS := $(patsubst %.c,$(B)/%.o,$(wildcard render/*/*.c)) $(patsubst %,$(B)/%.o,$(wildcard render/*/*.cc))

$(RENDER_OBJECTS) $(B)/render/main.o: EXTRA_CFLAGS = $(RENDER_CFLAGS)
# Its predicates are exact by intervals, which change the mode of rounding, and by long numbers, of
# which CGAL shifts negative digits.
$(B)/render/scene/scene_triangulate.cc.o: EXTRA_CXXFLAGS = -frounding-math -fno-sanitize=shift-base

RENDER_OBJECTS += $(B)/render/gl/gl_shaders.o
$(B)/render/gl/gl_shaders.c: $(sort $(wildcard render/gl/shaders/*.glsl)) bakeslab/base/embed.sh | $(SETUP_FIRST)
	$(call embed,gl_)

$(B)/librender.a: $(RENDER_OBJECTS)

$(RENDER_BIN): $(B)/render/main.o $(B)/librender.a $(B)/libslab.a
	@mkdir -p $(@D)
	$(call say,LINK,$@)
	$(Q)$(CC) $(ALL_LDFLAGS) $^ $(RENDER_LIBS) $(ALL_LDLIBS) -o $@

$(RENDER_BIN): | $(IMAGE)

RENDER_PAGES := $(B)/man/renderslab.1 $(patsubst render/cmd/cmd_%.c,$(B)/man/renderslab-%.1,$(wildcard render/cmd/cmd_*.c))
MAN_PAGES += $(RENDER_PAGES)

$(RENDER_PAGES): $(B)/man/%.1: bakeslab/cli/man.sh $(RENDER_BIN)
	$(man_page)

# Figures of the paper. The lamp at the paper's resolution is baked once: only another lamp
# makes it anew, not another bakeslab.
FIGURES := build/figures
FIGURE3 := render/scenes/figure3.obj render/scenes/figure3.mtl

$(FIGURES)/parabolic.tif: lamps/parabolic.pov include-pov/canned.inc include-pov/canned_bake.inc | $(BAKE_BIN)
	@mkdir -p $(@D)
	@echo 'Baking $< at 64x64 x 64x64 (10 CPU minutes; goes on where it was interrupted)'
	@$(BAKE_BIN) bake $< -o $@ --uv 64x64 --st 64x64 --uniform --rays 4

# The scene of figure 3, lit by the first prerequisite.
define figure3
	@echo 'Rendering $@'
	@$(RENDER_BIN) image $(FIGURE3:%.mtl=) --light '$< at=0,36,0' --camera 'from=-12,34,-100 at=-2,13,0 fov=52' \
	  --size 480x300 --samples 2 --method reference --exposure 6.8989 --preview $(@:.exr=.png) --stats $(@:.exr=.json) -o $@
endef

$(FIGURES)/figure3.exr: $(FIGURES)/parabolic.tif $(FIGURE3) $(RENDER_BIN)
	$(figure3)

# Its bottom: half the resolution in each direction.
$(FIGURES)/half.tif: $(FIGURES)/parabolic.tif | $(BAKE_BIN)
	@$(BAKE_BIN) convert $< -o $@ --uv 32x32 --st 32x32

$(FIGURES)/figure3-half.exr: $(FIGURES)/half.tif $(FIGURE3) $(RENDER_BIN)
	$(figure3)

# Figure 6: an office under two sizes of the lamp, by POV-Ray and, as a mesh, by renderslab.
$(FIGURES)/parabolic_%.tif: lamps/parabolic_%.pov lamps/parabolic.pov include-pov/canned.inc include-pov/canned_bake.inc | $(BAKE_BIN)
	@mkdir -p $(@D)
	@echo 'Baking $< (a minute)'
	@$(BAKE_BIN) bake $< -o $@ --uv 16x16 --st 48x48 --rays 8

$(FIGURES)/parabolic_%.inc: $(FIGURES)/parabolic_%.tif
	@$(BAKE_BIN) include $< -o $@

$(FIGURES)/office.obj: include-pov/office.pov include-pov/office_shapes.inc render/figures/figure6.sh
	@mkdir -p $(@D)
	@render/figures/figure6.sh mesh $(@D)

$(FIGURES)/figure6-%-povray.exr: $(FIGURES)/parabolic_%.inc $(FIGURES)/office.obj
	@echo 'Rendering $@'
	@render/figures/figure6.sh by_povray $@ $(if $(filter large,$*),Declare=Large=1)

$(FIGURES)/figure6-%-renderslab.exr: $(FIGURES)/parabolic_%.tif $(FIGURES)/office.obj $(RENDER_BIN)
	@echo 'Rendering $@'
	@RENDERSLAB=$(RENDER_BIN) render/figures/figure6.sh by_renderslab $< $@

$(FIGURES)/figure6.txt: $(foreach lamp,small large,$(FIGURES)/figure6-$(lamp)-povray.exr $(FIGURES)/figure6-$(lamp)-renderslab.exr)
	@render/figures/figure6.sh compare $(@D) >$@

# Figure 5: a wall that the slide projector lights at an angle, by OpenGL as in the paper, and by
# the reference.
FIGURE5 := render/scenes/figure5.obj render/scenes/figure5.mtl
FIGURE5_PICTURES := $(FIGURES)/figure5-gl.exr $(FIGURES)/figure5-reference.exr

$(FIGURES)/slide.png: lamps/projector/slide.pov
	@mkdir -p $(@D)
	@povray +I$< +O$@ +W768 +H512 +A0.1 -D >$(@:.png=.log) 2>&1 || { echo 'POV-Ray failed; see $(@:.png=.log)' >&2; exit 1; }

$(FIGURES)/projector.tif: $(FIGURES)/slide.png $(BAKE_BIN)
	@$(BAKE_BIN) projector $< -o $@ --aperture 0.3 --focus 2 --width 2.4

$(FIGURES)/figure5-%.exr: $(FIGURES)/projector.tif $(FIGURE5) $(RENDER_BIN)
	@echo 'Rendering $@'
	@$(RENDER_BIN) image $(FIGURE5:%.mtl=) --light '$< at=-0.845,0,-1.813 toward=0,0,0' --camera 'from=0.45,0,-3.1 at=0.45,0,0 fov=62' \
	  --size 400x250 --samples 2 --method $* --exposure -8.0589 --preview $(@:.exr=.png) -o $@

.PHONY: figures
figures: $(FIGURES)/figure3.exr $(FIGURES)/figure3-half.exr | $(FIGURES)/figure6.txt $(FIGURE5_PICTURES) ## render the figures of the paper
	@render/figures/figure3.sh difference $^ $(FIGURES)/figure3-difference.png
	@echo 'CPU seconds at 80x50 pixels, where the paper tells a factor of 7.4:'
	@RENDERSLAB=$(RENDER_BIN) render/figures/figure3.sh factors $(FIGURES)/parabolic.tif $(FIGURES)/half.tif
	@echo "figure 5: the sum over 8x8 views by gl and the reference differ by $$(render/figures/figure6.sh difference $(FIGURE5_PICTURES)) % (relative RMS)"
	@cat $(FIGURES)/figure6.txt
	@echo 'Look at $(^:.exr=.png) $(FIGURES)/figure3-difference.png $(FIGURE5_PICTURES:.exr=.png) $(FIGURES)/figure6-*.png'
