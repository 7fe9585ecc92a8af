/* cluster_text.h - the include file of a cluster. The caller checks the stream. */
#ifndef CLUSTER_TEXT_H
#define CLUSTER_TEXT_H

#include "include/cluster/cluster.h"
#include "include/text/include_text.h"

void cluster_print(const struct cluster *cluster, const struct include_text *text, FILE *out);

#endif
