/* The tables that the demo prints. */
#ifndef DARTSWEEP_DEMO_TABLES_H
#define DARTSWEEP_DEMO_TABLES_H

#include <stdio.h>

#include "catheter.h"
#include "changes.h"
#include "fall.h"
#include "run.h"
#include "scalpel.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { kCatheters = 3, kMostChanges = 4 };

/* The cloud: `wall` is how many faces of the vessel's wall are marked. */
void print_cloud(FILE *out, const demo_run *run, const demo_mesh *mesh, size_t steps, size_t threads, size_t wall);
/* Bodies in environments that stay as they are. */
void print_bodies(FILE *out, const demo_catheter *catheters, const demo_fall *fall);
/* Environments that change, and what lies in them: at most kMostChanges of them. */
void print_changes(FILE *out, const change_figures *const *changes, size_t count);
/* What the scalpel did. */
void print_scalpel(FILE *out, const demo_scalpel *scalpel);

#ifdef __cplusplus
}
#endif

#endif
