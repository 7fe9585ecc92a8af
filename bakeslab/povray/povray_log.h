/* povray_log.h - what POV-Ray's log, the file `log` of a job's folder, says: why it failed, its
 * counts, how far it is. A log may be of any length: only a line at a time is held. */
#ifndef POVRAY_LOG_H
#define POVRAY_LOG_H

#include <stdbool.h>
#include <stddef.h>

/* Why POV-Ray failed, in its own words and as one line: the error of the parser with file and line,
 * the fatal error with what announced it, or the last thing that it said. Empty where there is
 * none. */
void povray_log_reason(const char *directory, char *reason, size_t size);

/* Whether POV-Ray ended before it began: it gives its threads 3 s to start, and on a machine that
 * stands still for as long it gives up. It may be started again. */
bool povray_log_is_late(const char *directory);

/* A count from POV-Ray's statistics, such as "Number of photons shot:"; -1 where the log has no
 * such line. */
double povray_statistic(const char *directory, const char *label);

/* Seconds of all its threads, by its own count: parsing, photons, radiosity, tracing. */
double povray_log_cpu(const char *directory);

/* Part of a running job that is rendered; an `animation` counts frames, a still its pixels. */
double povray_log_progress(const char *directory, bool animation);

#endif
