#!/usr/bin/env python3
"""wheel.py VERSION PACKAGE OUT LIBRARY...: writes OUT/pdplate-VERSION-....whl, the module with its libraries beside it.

The wheel is for the interpreter that runs this script and needs the system's libraries that `cases/build` installs."""
import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

METADATA = """Metadata-Version: 2.1
Name: pdplate
Version: {version}
Summary: Cracked Mindlin plates in peridynamics
Requires-Python: =={python}.*
Requires-Dist: numpy
"""


def write_wheel(version, package, out, libraries):
    """Path of the wheel of the files of a package and of libraries."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    about = f"pdplate-{version}.dist-info"
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    own = [file for file in package.iterdir() if file.suffix == ".py" or file.name.endswith(suffix)]
    contents = {f"pdplate/{file.name}": file.read_bytes() for file in sorted(own) + libraries}
    contents[f"{about}/METADATA"] = METADATA.format(version=version, python=sysconfig.get_python_version()).encode()
    contents[f"{about}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: pdplate\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = f"{about}/RECORD"
    lines = [f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}"
             for name, data in contents.items()]
    contents[record] = "\n".join([*lines, f"{record},,", ""]).encode()
    for before in out.glob("pdplate-*.whl"):
        before.unlink()
    wheel = out / f"pdplate-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in contents.items():
            archive.writestr(name, data)
    return wheel


if __name__ == "__main__":
    package, out, *libraries = map(pathlib.Path, sys.argv[2:])
    print(write_wheel(sys.argv[1], package, out, libraries))
