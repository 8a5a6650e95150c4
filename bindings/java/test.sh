#!/usr/bin/env bash
# The tests of the jar, and the example with what it takes from a repository: bindings/java/test.sh FOLDER, where Dartsweep is
# installed as a static library. The repository is one of its own, so that no other version is there.
set -euo pipefail
library=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
source=bindings/java
out=$PWD/build/java
mvn() { command mvn -q -B "-Dmaven.repo.local=$PWD/build/maven" "$@"; }

rm -rf "$out/maven/target/surefire-reports"
cmake -S $source -B "$out" -DCMAKE_BUILD_TYPE=Release -DDSW_QUICK_BUILD=ON -DCMAKE_PREFIX_PATH="$library"
cmake --build "$out"
mvn -f $source/pom.xml "-Dnative=$out/maven" install
mvn -f $source/examples/pom.xml "-Doutput=$out/example" compile exec:exec
mkdir -p "$out/readme"
python3 bindings/tests/readme_code.py $source/README.md java >"$out/readme/Contacts.java"
java -cp "$(echo "$out"/maven/target/dartsweep-*.jar | tr ' ' :)" "$out/readme/Contacts.java" | grep "vertex 1 met x = 1.0 after 0.5"
if grep -l "WARNING in native method" "$out"/maven/target/surefire-reports/*; then exit 1; fi # by -Xcheck:jni
printf '\njava: %s tests passed, and the example\n' "$(grep -ho '<testcase ' "$out"/maven/target/surefire-reports/*.xml | wc -l)"
