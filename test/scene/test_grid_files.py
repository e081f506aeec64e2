# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Gridded winds and currents from NPZ and NetCDF: what is read, and the line for each fault."""

import numpy as np
import pytest
from scipy.io import netcdf_file

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.scene.grid_files import grid_numbers, read_grid

T, X, Y, Z = [0.0, 60.0], [0.0, 10.0, 30.0], [-5.0, 5.0], [-20.0, -10.0, -1.0, 0.0]
RNG = np.random.default_rng(8)
U, V, W = RNG.normal(size=(3, 2, 3, 2, 4))
FULL = {'t': T, 'x': X, 'y': Y, 'z': Z, 'u': U, 'v': V, 'w': W}


@pytest.fixture
def npz(tmp_path):
    def write(**arrays):
        path = tmp_path / 'flow.npz'
        np.savez_compressed(path, **arrays)
        return path

    return write


@pytest.fixture
def netcdf(tmp_path):
    def write(variables, name='flow.nc'):
        """Each variable: (dimensions, values, attributes)."""
        path = tmp_path / name
        with netcdf_file(path, 'w') as file:
            for key, (dimensions, values, attributes) in variables.items():
                for dimension, size in zip(dimensions, np.shape(values), strict=True):
                    if dimension not in file.dimensions:
                        file.createDimension(dimension, size)
                variable = file.createVariable(key, np.asarray(values).dtype.char, dimensions)
                variable[:] = values
                for attribute, value in attributes.items():
                    setattr(variable, attribute, value)
        return path

    return write


def test_npz_with_all_axes(npz):
    grid = read_grid(npz(**FULL))
    for axis, expected in zip(grid.axes, (T, X, Y, Z), strict=True):
        np.testing.assert_array_equal(axis, expected)
    np.testing.assert_array_equal(grid.velocity, np.stack([U, V, W], axis=-1))


def test_axes_and_the_vertical_component_may_be_left_out(npz):
    grid = read_grid(npz(x=X, z=Z, u=U[0, :, 0], v=V[0, :, 0]))
    assert [axis.size for axis in grid.axes] == [1, 3, 1, 4]
    np.testing.assert_array_equal(grid.velocity[0, :, 0, :, 0], U[0, :, 0])
    np.testing.assert_array_equal(grid.velocity[..., 2], 0)


def test_the_numbers_for_the_model(npz):
    numbers = grid_numbers(read_grid(npz(**FULL)))
    assert numbers[:4].tolist() == [2, 3, 2, 4]
    assert numbers[4 : 4 + 11].tolist() == [*T, *X, *Y, *Z]
    assert numbers[15:18].tolist() == [U[0, 0, 0, 0], V[0, 0, 0, 0], W[0, 0, 0, 0]]
    assert len(numbers) == 4 + 11 + 3 * 48


def test_netcdf_with_its_own_order_units_and_packing(netcdf):
    order = ('time', 'z', 'y', 'x')
    packed = np.round(U.transpose(0, 3, 2, 1) / 0.001).astype('i2')
    path = netcdf({
        'time': (('time',), np.array([0.0, 1.0]), {'units': 'minutes since 2020-01-01'}),
        'x': (('x',), np.array(X) / 1000, {'units': 'km'}),
        'y': (('y',), Y, {'units': 'm'}),
        'z': (('z',), Z, {'units': 'm'}),
        'u': (order, packed, {'units': 'm s-1', 'scale_factor': 0.001}),
        'v': (order, V.transpose(0, 3, 2, 1), {}),
    })  # fmt: skip
    grid = read_grid(path)
    for axis, expected in zip(grid.axes, (T, X, Y, Z), strict=True):
        np.testing.assert_allclose(axis, expected)
    np.testing.assert_allclose(grid.velocity[..., 0], U, atol=6e-4)
    np.testing.assert_array_equal(grid.velocity[..., 1], V)


def fault(path):
    with pytest.raises(ConfigError) as caught:
        read_grid(path)
    line = str(caught.value)
    assert line.startswith(f'{path}: ')
    assert '\n' not in line
    return line


@pytest.mark.parametrize(
    ('arrays', 'words'),
    [
        (FULL | {'t': [60.0, 0.0]}, 'axis t: must rise strictly; 0 follows 60 (point 2)'),
        (FULL | {'u': np.where(U[1, 2, 0, 3] == U, np.nan, U)},
         '1 gaps (not finite), the first at t = 60, x = 30, y = -5, z = 0'),
        ({k: v for k, v in FULL.items() if k != 'v'}, "no component 'v'; needed: u, v"),
        ({'u': U, 'v': V}, 'no axis'),
        (FULL | {'v': V[:, :2]}, "component 'v': shape (2, 2, 2, 4); allowed: (2, 3, 2, 4)"),
        (FULL | {'x': np.array(['a', 'b', 'c'])}, "array 'x': <U1; must be numbers"),
        (FULL | {'u': np.array([{}], dtype=object)}, "array 'u': object; must be numbers"),
    ],
)  # fmt: skip
def test_npz_faults(npz, arrays, words):
    assert words in fault(npz(**arrays))


def test_files_that_are_none(tmp_path):
    assert 'no such file' in fault(tmp_path / 'none.npz')
    assert "kind '.grib' is not known; allowed: .npz, .nc" in fault(tmp_path / 'flow.grib')
    for name in ('text.npz', 'text.nc'):
        (tmp_path / name).write_text('time,u,v\n')
        assert 'cannot be read' in fault(tmp_path / name)
    (tmp_path / 'new.nc').write_bytes(b'\x89HDF\r\n\x1a\n' + bytes(64))
    assert 'is NetCDF-4; write it as classic: nccopy' in fault(tmp_path / 'new.nc')


def test_netcdf_faults(netcdf):
    axes = {'x': (('x',), np.array(X), {}), 'y': (('y',), np.array(Y), {})}
    u = {'u': (('x', 'y'), U[0, :, :, 0], {}), 'v': (('x', 'y'), V[0, :, :, 0], {})}
    assert read_grid(netcdf(axes | u)).velocity.shape == (1, 3, 2, 1, 3)
    degrees = {'x': (('x',), np.array(X), {'units': 'degrees_east'})}
    assert "variable 'x': units 'degrees_east'; allowed: m, " in fault(netcdf(axes | u | degrees))
    knots = {'u': (('x', 'y'), U[0, :, :, 0], {'units': 'knots'})}
    assert "variable 'u': units 'knots'; allowed: m/s" in fault(netcdf(axes | u | knots))
    level = {'u': (('x', 'level'), U[0, :, :, 0], {})}
    assert "variable 'u': dimension 'level'; allowed: t, x, y, z" in fault(
        netcdf(axes | u | level)
    )
    hole = np.where(U[0, :, :, 0] == U[0, 1, 1, 0], -999.0, U[0, :, :, 0])
    masked = {'u': (('x', 'y'), hole, {'missing_value': -999.0})}
    assert '1 gaps (not finite), the first at' in fault(netcdf(axes | u | masked))
