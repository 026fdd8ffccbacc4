# SPDX-License-Identifier: BSD-3-Clause
"""Makes programs and modules independent of the libraries of this machine.

    bundle_libraries.py LIBRARIES FILE...
    bundle_libraries.py --wheel WHEEL OUTPUT_FOLDER

Copies the shared libraries that the files need into the folder LIBRARIES, with their licenses, and
lets the files find them there. Libraries that every Linux has stay out. The second form does the
same for a wheel, and gives it the manylinux tag of the C library of this machine.
"""
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# As manylinux wheels may expect them: the C and C++ libraries, and the loader.
OF_THE_SYSTEM = re.compile(
    r'(ld-linux.*|lib(c|m|dl|rt|util|pthread|resolv|nsl|stdc\+\+|gcc_s))\.so\.\d+')


def output_of(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def needed(file):
    """Names and paths of the libraries of this file, and of their libraries."""
    found = re.findall(r'^\s*(\S+) => (\S+)', output_of('ldd', file), re.MULTILINE)
    for name, path in found:
        if path == 'not':
            raise SystemExit(f'{file}: {name} is missing')
    return {name: path for name, path in found if not OF_THE_SYSTEM.fullmatch(name)}


def copy_license(library, folder):
    """Copies the license of Debian's package of this library, if it is of one."""
    path = str(Path(library).resolve())
    owner = subprocess.run(['dpkg-query', '-S', path, path.removeprefix('/usr')],
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    for package in re.findall(r'^([^:,]+)', owner.stdout):
        shutil.copy(f'/usr/share/doc/{package}/copyright', folder / f'{package}.txt')


def bundle(libraries, files):
    libraries = Path(libraries)
    copies = {}
    for file in files:
        for name, path in needed(file).items():
            copies[name] = path
    licenses = libraries / 'licenses'
    licenses.mkdir(parents=True, exist_ok=True)
    for name, path in copies.items():
        shutil.copy(path, libraries / name)
        os.chmod(libraries / name, 0o644)
        copy_license(path, licenses)
        subprocess.run(['patchelf', '--set-rpath', '$ORIGIN', libraries / name], check=True)
    for file in files:
        place = os.path.relpath(libraries, Path(file).parent)
        subprocess.run(['patchelf', '--set-rpath', f'$ORIGIN/{place}', file], check=True)


def bundle_wheel(wheel, folder):
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([sys.executable, '-m', 'wheel', 'unpack', wheel, '-d', work], check=True,
                       stdout=subprocess.DEVNULL)
        root = next(Path(work).iterdir())
        modules = list(root.rglob('*.so'))
        bundle(root / 'flbc.libs', modules)
        version = platform.libc_ver()[1].replace('.', '_')
        tag = f'manylinux_{version}_{platform.machine()}'
        facts = next(root.glob('*.dist-info')) / 'WHEEL'
        facts.write_text(re.sub(r'(Tag: \S+-)linux_\w+', rf'\g<1>{tag}', facts.read_text()))
        subprocess.run([sys.executable, '-m', 'wheel', 'pack', root, '-d', folder], check=True,
                       stdout=subprocess.DEVNULL)


if __name__ == '__main__':
    if sys.argv[1] == '--wheel':
        bundle_wheel(*sys.argv[2:])
    else:
        bundle(sys.argv[1], [Path(file) for file in sys.argv[2:]])
