#include "canned.inc"
#declare Canned_Housing = sphere { 0, 1 }
