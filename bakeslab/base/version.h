/* version.h - of both programs; provenance names "bakeslab " CANNED_VERSION as the tool. */
#ifndef VERSION_H
#define VERSION_H

#define CANNED_VERSION "0.1.0"

#endif
