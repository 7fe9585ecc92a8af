# Lamps are read, and installed as examples. The shelf: all of them baked or imported, and a page of
# what they are and do. SHELF is its folder, SHELF_LAMPS are the scripts and what is imported,
# SHELF_FLAGS options of `bakeslab bake` in place of those that each script's header recommends.
LAMP_FILES := $(filter-out %.mk,$(sort $(wildcard lamps/*.pov lamps/*.ies lamps/*.rays lamps/*.inc lamps/*.png lamps/*.md lamps/LICENSE lamps/projector/* lamps/gallery/*.*)))
SHELF ?= build/shelf
SHELF_LAMPS ?= $(sort $(wildcard lamps/*.pov lamps/*.ies lamps/*.rays))
SHELF_FLAGS ?=

.PHONY: lamps
lamps: $(BIN) ## bake all lamps, and show them in build/shelf/index.html
	@mkdir -p $(SHELF)
	@rm -f $(SHELF)/*.error
	+@$(MAKE) -k --no-print-directory -C $(SHELF) -f $(abspath lamps/shelf.mk) LAMPS=$(call quote,$(abspath $(SHELF_LAMPS))) \
	  BAKE=$(abspath $(BAKE_BIN)) RENDER=$(abspath $(RENDER_BIN)) SHELF_FLAGS=$(call quote,$(SHELF_FLAGS)) all || true
	@cd $(SHELF) && $(abspath lamps/shelf.sh) page $(abspath $(SHELF_LAMPS))
	@echo 'Look at $(SHELF)/index.html'

include lamps/gallery/flat.mk
