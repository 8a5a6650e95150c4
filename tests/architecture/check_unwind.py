#!/usr/bin/env python3
"""Fails if a function without an unwind table calls something that may throw. An exception that comes to such a function ends
the program. Calls through pointers are not seen: there the compiler looks at the pointer's type.

usage: check_unwind.py OBJDUMP LIBRARY | --self-test OBJDUMP C++_COMPILER
"""
import bisect
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

# What throws nothing of other libraries.
QUIET = re.compile(r"(mem(cpy|move|set|cmp|chr)|str\w+|v?snprintf|getenv|abort|malloc|free|madvise|posix_memalign|aligned_alloc"
                   r"|(sqrt|floor|ceil|fmax|fmin|ldexp|frexp|ilogb|nextafter)f?|__popcountdi2|__u?(div|mod)ti3|__cpu_indicator_init"
                   r"|pthread_\w*(lock|init|destroy|signal|broadcast)|__cxa_(finalize|guard_(acquire|release|abort)|begin_catch|atexit)"
                   r"|_Zd[la]Pv\w*|_Zn[wa]mRKSt9nothrow_t|_ZSt9terminatev|_ZN\w+D[0-2]Ev|_ZNSt6chrono\w+3nowEv|__stack_chk_fail"
                   r"|__tls_get_addr)(@|$)")


def sections(data):
    """Name: (address, bytes) of a 64-bit ELF file."""
    start, = struct.unpack_from("<Q", data, 0x28)
    size, count, names = struct.unpack_from("<3H", data, 0x3A)
    headers = [struct.unpack_from("<2I4Q", data, start + size * i) for i in range(count)]
    strings = headers[names][4]
    return {data[strings + name:data.index(b"\0", strings + name)].decode(): (address, data[offset:offset + length])
            for name, _, _, address, offset, length in headers}


def uleb(data, at):
    value = shift = 0
    while True:
        value, shift, at = value | (data[at] & 127) << shift, shift + 7, at + 1
        if data[at - 1] < 128:
            return value, at


def lets_out(data, at):
    """Whether a call site of this LSDA has no landing pad: what is thrown there goes on to the caller."""
    if data[at] != 0xFF:
        return True # not written by GCC
    at += 1
    if data[at] != 0xFF:
        _, at = uleb(data, at + 1)
    else:
        at += 1
    encoding, (length, at) = data[at], uleb(data, at + 1)
    end = at + length
    while at < end:
        if encoding != 1:
            return True
        for _ in range(2):
            _, at = uleb(data, at)
        landing, at = uleb(data, at)
        _, at = uleb(data, at)
        if landing == 0:
            return True
    return False


def tables(data):
    """Sorted (start, end, whether an exception may leave it) of all functions with a table."""
    found, named = [], sections(data)
    base, frame = named[".eh_frame"]
    lsda_base, lsda = named.get(".gcc_except_table", (0, b""))
    at, common = 0, {}
    while at + 4 <= len(frame):
        length, = struct.unpack_from("<I", frame, at)
        if length == 0:
            break
        back, = struct.unpack_from("<I", frame, at + 4)
        if back == 0:
            end = frame.index(b"\0", at + 9)
            common[at] = b"L" in frame[at + 9:end]
        else:
            start, size = struct.unpack_from("<iI", frame, at + 8) # relative to its place, as the linkers of Linux write it
            start += base + at + 8
            out = True
            if common[at + 4 - back]:
                pointer, = struct.unpack_from("<i", frame, at + 17)
                if pointer:
                    out = lets_out(lsda, base + at + 17 + pointer - lsda_base)
            found.append((start, start + size, out))
        at += 4 + length
    return sorted(found)


def faults_of(objdump, library):
    """Calls of what may throw, from functions without tables; the number of calls from these. A jump to another function is no fault,
    for what jumps has left the stack: but then it lets out what the other function throws."""
    known = tables(pathlib.Path(library).read_bytes())
    starts = [start for start, _, _ in known]

    def table_at(address):
        i = bisect.bisect_right(starts, address) - 1
        return known[i] if i >= 0 and address < known[i][1] else None

    text = subprocess.run([objdump, "-d", "--no-show-raw-insn", "-j", ".text", library], check=True, capture_output=True, text=True).stdout
    calls, jumps, names, function = [], [], {}, 0
    for line in re.finditer(r"^(?:([0-9a-f]+) <(.+)>:| +([0-9a-f]+):\s+(?:bnd )?(call|jmp)q?\s+([0-9a-f]+) <(.+?)>)\s*$", text, re.M):
        if line[1]:
            function = int(line[1], 16)
            names[function] = line[2]
        elif not table_at(int(line[3], 16)):
            target, name = int(line[5], 16), line[6]
            if not QUIET.match(name):
                (calls if line[4] == "call" else jumps).append((function, target, name))

    loud = set() # functions without tables that let out what another one throws

    def may_throw(target, name):
        table = table_at(target)
        return "@plt" in name or target in loud or table is not None and table[2]

    while more := {function for function, target, name in jumps if may_throw(target, name)} - loud:
        loud |= more
    return [f"{names[function]} calls {name}" for function, target, name in calls if may_throw(target, name)], len(calls)


def self_test(objdump, compiler):
    caller = "void g(int) noexcept; void f(int n) { for (; n; --n) g(n); } void h(int); void k(int n) { h(n + 1); }"
    thrower = "void h(int n) { if (n == 7) throw n; } "
    callees = {thrower + "void g(int n) { h(n); h(n); }": 1, thrower + "void k(int); void g(int n) { k(n); }": 1,
               thrower + "void g(int n) noexcept { h(n); }": 0, thrower + "int i; void g(int n) { i = n; }": 0}
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        for callee, expected in callees.items():
            for name, text in (("caller", caller), ("callee", callee)):
                (path / f"{name}.cpp").write_text(text)
            subprocess.run([compiler, "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-fno-asynchronous-unwind-tables", "-fno-dwarf2-cfi-asm",
                            path / "caller.cpp", path / "callee.cpp", "-o", path / "both.so"], check=True)
            faults, seen = faults_of(objdump, path / "both.so")
            if len(faults) != expected or seen == 0:
                sys.exit(f"{callee}\n{seen} calls, {len(faults)} faults where {expected} are expected")
    print(f"{len(callees)} libraries judged as they should be")


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--self-test":
        return self_test(*sys.argv[2:])
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    faults, seen = faults_of(*sys.argv[1:])
    if seen == 0:
        sys.exit("no function without a table calls anything: is the library stripped?")
    if faults:
        sys.exit("\n".join(faults))
    print(f"{seen} calls of functions without tables reach nothing that throws")


if __name__ == "__main__":
    main()
