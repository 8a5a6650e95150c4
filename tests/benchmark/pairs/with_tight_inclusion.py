#!/usr/bin/env python3
"""Runs dartsweep_pairs in one process with Tight-Inclusion: with_tight_inclusion.py LIBRARY [OPTION]...

LIBRARY is libdartsweep_pairs.so, OPTIONs are those of dartsweep_pairs. Tight-Inclusion is the one in the IPC Toolkit's
Python module, `ipctk`. Its C++ functions are called directly: no query passes through Python.
"""

import ctypes
import sys

import ipctk

VECTOR, ARRAY = "RKN5Eigen6MatrixIdLi3ELi1ELi0ELi3ELi1EEE", "RKNS0_5ArrayIdLi3ELi1ELi0ELi3ELi1EEE"
# ticcd::NAME(eight points, error, separation, time, tolerance, end, iterations, tolerance reached, no_zero_toi, method)
ARGUMENTS = f"E{VECTOR}{'S4_' * 7}{ARRAY}dRdddlS9_bNS_20CCDRootFindingMethodE"
NAMES = ("_ZN5ticcd13vertexFaceCCD" + ARGUMENTS, "_ZN5ticcd11edgeEdgeCCD" + ARGUMENTS)


def address(module, name):
    try:
        return ctypes.cast(getattr(module, name), ctypes.c_void_p)
    except AttributeError:
        print(f"pairs: this ipctk has no {name}")
        return None


def main():
    words = [word.encode() for word in sys.argv[1:]]
    module = ctypes.CDLL(ipctk.__file__)
    run = ctypes.CDLL(sys.argv[1]).dartsweep_pairs
    sys.exit(run(len(words), (ctypes.c_char_p * len(words))(*words), *(address(module, name) for name in NAMES)))


if __name__ == "__main__":
    main()
