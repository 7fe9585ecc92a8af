# What POV-Ray reads is installed as it is. The demo: the paper's lamp from script
# to slab to include to a picture, beside those that renderslab and the whole lamp give.
POV_FILES := $(sort $(filter-out %/flat.mk,$(shell find include-pov -type f)))

DEMO := build/demo
DEMO_READS := include-pov/demo.pov include-pov/demo.sh

$(DEMO)/parabolic.tif: lamps/parabolic.pov include-pov/canned.inc include-pov/canned_bake.inc $(BAKE_BIN)
	@mkdir -p $(@D)
	@echo 'Baking $< (about a minute on two processors)'
	@include-pov/demo.sh timed $(DEMO)/bake.seconds $(BAKE_BIN) bake $< -o $@

$(DEMO)/parabolic.inc: $(DEMO)/parabolic.tif
	@echo 'Writing the include file $@ and its image'
	@$(BAKE_BIN) include $< -o $@

$(DEMO)/canned.exr: $(DEMO)/parabolic.inc $(DEMO_READS)
	@echo 'Rendering the scene with the canned lamp'
	@include-pov/demo.sh render demo $@ +FE +W320 +H160 -A +L$(DEMO)

$(DEMO)/renderslab.exr: $(DEMO)/parabolic.tif render/scenes/demo.obj render/scenes/demo.mtl include-pov/demo.sh $(RENDER_BIN)
	@echo 'Rendering it with renderslab'
	@include-pov/demo.sh timed $(@:.exr=.seconds) $(RENDER_BIN) image render/scenes/demo.obj --light $< \
	  --camera 'from=-30,-8,-150 at=0,-60,-10 fov=58' --size 320x160 -o $@

$(DEMO)/full.exr: lamps/parabolic.pov include-pov/canned.inc $(DEMO_READS) | $(DEMO)/canned.exr
	@echo 'Rendering it with the whole lamp and its interreflection (half a minute)'
	@include-pov/demo.sh render demo $@ +FE +W320 +H160 -A +Llamps +Linclude-pov Declare=Full_Lamp=1

# By one thread, for the same bits each time: POV-Ray's radiosity depends on which comes first.
CORNER := +FN +W640 +H400 +WT1
$(DEMO)/corner-canned.png: $(DEMO)/parabolic.inc include-pov/corner.pov include-pov/demo.sh
	@echo 'Rendering a furnished corner with the canned lamp'
	@include-pov/demo.sh render corner $@ $(CORNER) +A0.2 +AM2 +R2 +L$(DEMO)

$(DEMO)/corner-full.png: lamps/parabolic.pov include-pov/canned.inc include-pov/corner.pov include-pov/demo.sh | $(DEMO)/corner-canned.png
	@echo 'Rendering it with the whole lamp, for as long'
	@include-pov/demo.sh render corner $@ $(CORNER) -A +Llamps +Linclude-pov Declare=Full_Lamp=1

.PHONY: demo
demo: $(DEMO)/canned.exr $(DEMO)/renderslab.exr $(DEMO)/full.exr $(DEMO)/corner-canned.png $(DEMO)/corner-full.png ## bake the paper's lamp, light scenes with it, compare with the full lamp
	@include-pov/demo.sh compare $(DEMO)
	@include-pov/demo.sh corner $(DEMO)
