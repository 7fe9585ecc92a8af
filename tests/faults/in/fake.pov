#include "canned.inc"
