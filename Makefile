# Canned light sources: one dependency graph. `make help` lists the targets.
# Each folder adds its own lines through flat.mk; objects go to build/$(config)/.

config ?= release
B := build/$(config)
prefix ?= /usr/local
SETUP ?= yes

CFLAGS_release  := -O2 -g
CFLAGS_debug    := -O0 -g
CFLAGS_sanitize := -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
WARN := -Wall -Wextra -Wshadow -Wconversion -Wstrict-prototypes -Wvla
PACKAGES_USED := libtiff-4 OpenEXR jansson libxxhash
PKG_CFLAGS = $(shell pkg-config --cflags $(PACKAGES_USED) 2>/dev/null)
PKG_LIBS = $(shell pkg-config --libs $(PACKAGES_USED) 2>/dev/null)

CC ?= gcc
ALL_CFLAGS = -std=c17 -D_GNU_SOURCE $(WARN) $(CFLAGS_$(config)) -Ibakeslab $(PKG_CFLAGS) -MMD -MP $(CFLAGS)
ALL_LDLIBS = $(PKG_LIBS) -lpthread -lm $(LDLIBS)

.DEFAULT_GOAL := all
.PHONY: all
.SECONDARY:
.DELETE_ON_ERROR:

include bakeslab/flat.mk
include tests/flat.mk

all: $(B)/bakeslab

$(B)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -c $< -o $@

-include $(shell find $(B) -name '*.d' 2>/dev/null)
