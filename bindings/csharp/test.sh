#!/usr/bin/env bash
# The tests of the assembly, then of the NuGet package and of that for Unity as a program finds them, with nothing else of ours on its way:
# bindings/csharp/test.sh FOLDER, where Dartsweep is installed as a static library.
set -euo pipefail
library=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
source=bindings/csharp
out=$PWD/build/csharp
package=$out/package
program=$out/example
plugins=$out/unity/Plugins/linux-x64

cmake -S $source -B "$out" -DCMAKE_BUILD_TYPE=Release -DDSW_QUICK_BUILD=ON -DCMAKE_PREFIX_PATH="$library"
cmake --build "$out"
if readelf -d "$package"/runtimes/linux-x64/native/*.so | grep NEEDED | grep -Ev '\[(lib(c|m|gcc_s|stdc\+\+)|ld-linux)'; then exit 1; fi
cp "$package"/runtimes/linux-x64/native/* "$package"
mcs -nologo -out:"$package/tests.exe" -r:"$package/Dartsweep.dll" $source/tests/*.cs
mono --debug "$package/tests.exe" bindings/tests/scenario.json | tee "$out/tests.txt"

rm -f "$out"/Dartsweep.*.nupkg # of other versions
python3 $source/pack.py $source/Dartsweep.nuspec "$package" "$out"
rm -rf "$program"
python3 -m zipfile -e "$out"/Dartsweep.*.nupkg "$program"
cp "$program"/lib/net45/* "$program"/runtimes/linux-x64/native/* "$program"
mcs -nologo -out:"$program/catheter.exe" -r:"$program/Dartsweep.dll" $source/examples/Catheter.cs
mono "$program/catheter.exe"
python3 bindings/tests/readme_code.py $source/README.md csharp >"$program/Contacts.cs"
mcs -nologo -out:"$program/contacts.exe" -r:"$program/Dartsweep.dll" "$program/Contacts.cs"
mono "$program/contacts.exe" | grep "vertex 1 met x = 1 after 0.5"
mcs -nologo -unsafe -nowarn:1591 -out:"$plugins/catheter.exe" $source/examples/Catheter.cs "$out"/unity/Runtime/*.cs
mono "$plugins/catheter.exe"
mcs -nologo -unsafe -nowarn:1591,649,414 -out:"$plugins/sample.exe" "$out"/unity/Samples~/*/*.cs $source/tests/unity/*.cs "$out"/unity/Runtime/*.cs
mono "$plugins/sample.exe"
rm "$plugins"/*.exe
echo "csharp: $(tail -n 1 "$out/tests.txt"), and the example"
