# What POV-Ray reads is installed as it is; the demo is a script.
POV_FILES := $(sort $(filter-out %/flat.mk,$(shell find include-pov -type f)))

.PHONY: demo
demo: $(BIN) ## bake the paper's lamp, light a scene with it, compare with the full lamp
	@mkdir -p build/demo
	@BAKESLAB=$(abspath $<) CANNED_INCLUDE=$(abspath include-pov) BUILD=build/demo include-pov/demo.sh
