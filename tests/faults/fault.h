/* Whether a fault that plant.py has put into the engine is on. In a tree of plant.py only. It is read again in each namespace into which
   the walk's sources are read, so it has no guard, and all that it declares is the same in each. */

extern "C" {
/** 0: off and not reached yet. 1: off. 2: on. */
extern unsigned char dsw_fault_states[];
/** Notes that the fault is reached, and returns whether it is on. */
bool dsw_fault_first(int fault) noexcept;
}

#undef dsw_fault
#define dsw_fault(fault) (dsw_fault_states[fault] != 1 && dsw_fault_first(fault))
