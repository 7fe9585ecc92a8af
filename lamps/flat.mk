# Lamps are read, not built; they are installed as examples.
LAMP_FILES := $(sort $(wildcard lamps/*.pov lamps/*.inc lamps/*.png lamps/README.md lamps/LICENSE))
