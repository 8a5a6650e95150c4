/* What both parts of the scenario share. */
#ifndef DARTSWEEP_BINDINGS_TESTS_SCENARIO_H
#define DARTSWEEP_BINDINGS_TESTS_SCENARIO_H

#include "dartsweep/dartsweep.h"

enum { LINKS = 12 };

/* The result: a stage begins, and what it lists follows. */
void stage(const char *name);
void integer(uint64_t value);
void number(double value);
void say_flight(const dsw_flight *flight);
void say_sweep(const dsw_sweep *sweep);
void say_contacts(const char *stage_name, const dsw_body_contact *contacts, size_t count);
void say_nearest(const dsw_nearest *nearest);
void say_deformation(const dsw_deform_report *report);

/* Cuts along the blade and lists what came of it. */
void cut(dsw_environment *environment, const dsw_cut_desc *desc);

/* Ends the program where a call has failed. */
void must(dsw_status status);

/* Draws 0 .. 64 in steps of 1/1024. */
extern unsigned seed;
double draw(void);

/* Saves an environment, or a scene unless that is null; lists bytes and their sum. The caller frees the block. */
size_t save(const dsw_environment *environment, const dsw_scene *scene, unsigned char **block);

void plane(void);

#endif
