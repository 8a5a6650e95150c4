/* Whether a fault that plant.py has put into the engine is on. In a tree of plant.py only. */
#ifndef DARTSWEEP_TESTS_FAULT_H
#define DARTSWEEP_TESTS_FAULT_H

/** 0: off and not reached yet. 1: off. 2: on. */
extern unsigned char dsw_fault_states[];
/** Notes that the fault is reached, and returns whether it is on. */
bool dsw_fault_first(int fault) noexcept;

inline bool dsw_fault(int fault) noexcept { return dsw_fault_states[fault] != 1 && dsw_fault_first(fault); }

#endif
