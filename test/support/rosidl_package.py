# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Builds a ROS package of messages and services from its texts, with ROS's own generators.

The wheels lack tf2_msgs and simulation_interfaces, but have the generators. With a compiler they
make what ``colcon build`` makes: Python classes, type support for Fast DDS, and their hashes.
"""

import json
import os
import subprocess
import sys
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PREFIX = Path(sys.prefix)
_KINDS = ('rosidl_typesupport_fastrtps_c', 'rosidl_typesupport_introspection_c')
_NAMES = {'c': 'rosidl_generator_c', 'rosidl_typesupport_c': 'rosidl_typesupport_c'}
_NAMES |= {kind: kind for kind in _KINDS}
_LIBRARIES = (
    'rosidl_runtime_c', 'rosidl_typesupport_c', 'rosidl_typesupport_fastrtps_c',
    'rosidl_typesupport_fastrtps_cpp', 'rosidl_typesupport_introspection_c', 'rcutils',
    'rcpputils', 'fastcdr', 'rmw',
)  # fmt: skip


def build(package, texts, needs, folder, compiled=True):
    """
    Build a package into a folder.

    ``texts`` holds the definitions by ``msg/Name`` and ``srv/Name``, ``needs`` the packages that
    they use. Returns what a process needs in its environment to find it. Without the compiled part
    its Python classes hold values, but are neither sent nor received.
    """
    script = Path(__file__)
    task = {
        'package': package,
        'texts': texts,
        'needs': list(needs),
        'folder': str(folder),
        'compiled': compiled,
    }
    index = {'AMENT_PREFIX_PATH': str(PREFIX)}
    done = subprocess.run(
        [sys.executable, str(script)], env={**os.environ, **index}, input=json.dumps(task),
        text=True, capture_output=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-4000:]
    paths = os.environ.get('PYTHONPATH', '').split(os.pathsep)
    return {
        'PYTHONPATH': os.pathsep.join(filter(None, [str(folder), *paths])),
        'LD_LIBRARY_PATH': os.pathsep.join(
            filter(None, [f'{folder}/lib', os.environ.get('LD_LIBRARY_PATH', '')])
        ),
        'AMENT_PREFIX_PATH': os.pathsep.join(
            filter(None, [str(folder), os.environ.get('AMENT_PREFIX_PATH', ''), str(PREFIX)])
        ),
    }


def _build(package, texts, needs, folder, compiled):
    """Generate, compile and lay out a package; runs in a process of its own."""
    generated = _generate(package, texts, needs, folder / 'made', compiled)
    target = folder / package
    (folder / 'lib').mkdir(parents=True, exist_ok=True)
    index = folder / 'share/ament_index/resource_index/rosidl_interfaces'
    index.mkdir(parents=True, exist_ok=True)
    (index / package).write_text(''.join(f'{name}.idl\n' for name in texts))
    for path in generated['py'].rglob('*.py'):
        place = target / path.relative_to(generated['py'])
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(path.read_bytes())
    (target / '__init__.py').touch()

    if compiled:
        _compile(package, generated, needs, folder)


def _compile(package, generated, needs, folder):
    """Compile the libraries of a package, and the module that Python imports."""
    include, target = PREFIX / 'include', folder / package
    flags = ['-O0', '-fPIC', '-shared', f'-I{sysconfig.get_paths()["include"]}']
    flags += [f'-I{path.parent}' for path in generated.values()]
    flags += [f'-I{path}' for path in include.iterdir() if path.is_dir()]
    numpy = __import__('numpy').get_include()
    flags += [f'-I{include}', f'-I{numpy}', f'-L{PREFIX}/lib', f'-Wl,-rpath,{PREFIX}/lib']
    flags += [f'-L{folder}/lib', f'-Wl,-rpath,{folder}/lib']
    for kind in ('generator_c', 'typesupport_c', *(k.removeprefix('rosidl_') for k in _KINDS)):
        flags += [
            f'-l{need}__rosidl_{kind}'
            for need in needs
            if (PREFIX / f'lib/lib{need}__rosidl_{kind}.so').exists()
        ]
    flags += [f'-l{name}' for name in _LIBRARIES]

    def compile_library(output, sources, *more):
        assert sources, output
        command = ['c++' if sources[0].suffix == '.cpp' else 'cc', *map(str, sources)]
        done = subprocess.run(
            [*command, *flags, *more, '-o', str(output)],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            raise SystemExit(done.stderr[-3000:])

    def library(kind, *more):
        sources = sorted([*generated[kind].rglob('*.c'), *generated[kind].rglob('*.cpp')])
        compile_library(folder / f'lib/lib{package}__{_NAMES[kind]}.so', sources, *more)

    library('c')
    own = f'-l{package}__rosidl_generator_c'
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda kind: library(kind, own), _KINDS))
    library('rosidl_typesupport_c', own)
    # the converters and the module that Python imports, in one
    sources = sorted(generated['py'].rglob('*.c'))
    module = target / f'{package}_s__rosidl_typesupport_c.so'
    compile_library(module, sources, own, f'-l{package}__rosidl_typesupport_c', *(
        str(PREFIX / f'lib/lib{need}__rosidl_generator_py.so') for need in needs
    ))  # fmt: skip


def _generate(package, texts, needs, folder, compiled):
    """Return where each generator has written."""
    from rosidl_cli.command.translate.api import translate
    from rosidl_generator_c.cli import GenerateC
    from rosidl_generator_py.cli import GeneratePython
    from rosidl_typesupport_c.cli import GenerateCTypesupport
    from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport
    from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport

    source, idl = folder / 'source' / package, folder / 'idl' / package
    for name, text in texts.items():
        path = source / f'{name}.{name.split("/")[0]}'
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
    files = [f'{source}:{name}.{name.split("/")[0]}' for name in texts]
    includes = [str(PREFIX / 'share' / need) for need in needs]
    translate(
        package_name=package, interface_files=files, include_paths=includes, output_format='idl',
        output_path=idl,
    )  # fmt: skip
    files, includes = [f'{idl}:{name}.idl' for name in texts], [*includes, str(idl)]
    generators = [
        GenerateC('c'),
        GenerateCTypesupport('rosidl_typesupport_c', typesupport_implementations=_KINDS),
        GenerateFastRTPSCTypesupport('rosidl_typesupport_fastrtps_c'),
        GenerateIntrospectionCTypesupport('rosidl_typesupport_introspection_c'),
        GeneratePython('py', typesupport_implementations=['rosidl_typesupport_c']),
    ]
    generators = generators if compiled else generators[-1:]
    for generator in generators:
        generator.generate(package, files, includes, folder / generator.name / package)
    return {each.name: folder / each.name / package for each in generators}


if __name__ == '__main__':
    task = json.loads(sys.stdin.read())
    task['folder'] = Path(task['folder'])
    _build(**task)
