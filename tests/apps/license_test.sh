#!/bin/sh
# --version names the license that follows from the libraries in the program.
# license_test.sh FLBC
set -eu
symbols=$(nm -C "$1")
libraries=$(ldd "$1")
has() { printf '%s\n' "$symbols" "$libraries" | grep -q "$1"; }
expected=BSD-3-Clause
! has 'libcholmod\|cholmod_start' || expected=GPL-2.0-or-later
! has 'CGAL::' || expected=GPL-3.0-or-later
! has 'libtet\|tetgenmesh::' || expected=AGPL-3.0-or-later
"$1" --version | grep "^license of this program: $expected\(,\|\$\)"
