# The gallery: a scene and the lamp that it shows. A lamp that lies in $(SHELF) is taken from there,
# others are baked as their headers say. Each job is of one thread: make runs several.
GALLERY := build/gallery
GALLERY_LAMPS := street:street_lamp candle:candle_tin headlights:headlight office:fluorescent \
  desk:desk_lamp projector:slide_projector
GALLERY_SCENES := $(foreach pair,$(GALLERY_LAMPS),$(firstword $(subst :, ,$(pair))))

.PHONY: gallery
gallery: $(GALLERY_SCENES:%=$(GALLERY)/%.png) ## render six scenes with lamps of the shelf
	@for scene in $(GALLERY_SCENES); do echo "$(GALLERY)/$$scene.png: $$(cat $(GALLERY)/$$scene.seconds) CPU seconds"; done

# gallery_rules SCENE LAMP
define gallery_rules
$(GALLERY)/$(2).tif: lamps/$(2).pov include-pov/canned.inc include-pov/canned_bake.inc $(BAKE_BIN)
	@mkdir -p $$(@D)
	@echo 'Baking $$<'
	@$(BAKE_BIN) bake $$< -o $$@ -j 1 -q --yes $$$$(lamps/shelf.sh flags $$<)

$(GALLERY)/$(2).inc: $(or $(wildcard $(SHELF)/$(2).tif),$(GALLERY)/$(2).tif) $(BAKE_BIN)
	@mkdir -p $$(@D)
	@$(BAKE_BIN) include $$< -o $$@ -q

$(GALLERY)/$(1).png: lamps/gallery/$(1).pov lamps/gallery/gallery.inc $(GALLERY)/$(2).inc
	@echo 'Rendering $$<'
	@include-pov/demo.sh render ../lamps/gallery/$(1) $$@ +FN8 +W800 +H500 +A0.15 +AM2 +R2 +WT1 +Llamps/gallery +L$(GALLERY)
endef
$(foreach pair,$(GALLERY_LAMPS),$(eval $(call gallery_rules,$(firstword $(subst :, ,$(pair))),$(lastword $(subst :, ,$(pair))))))
