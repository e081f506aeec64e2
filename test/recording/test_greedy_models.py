# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Models in logs that ask for more memory or time than their files explain."""

import struct
import time
import zlib

import pytest

from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.schema.limits import VARIABLE
from test.support.hostile.commands import COMMANDS
from test.support.hostile.judge import judged
from test.support.log_files import rewritten
from test.support.log_models import body_model as model
from test.support.volumes import quick


def png(width, height):
    """Return a picture that is black, and small as a file."""

    def part(kind, data):
        return (
            struct.pack('>I', len(data)) + kind + data
            + struct.pack('>I', zlib.crc32(kind + data))
        )  # fmt: skip

    packer = zlib.compressobj(9)
    rows = b''.join(packer.compress(bytes(1 + width)) for _ in range(height)) + packer.flush()
    head = struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + part(b'IHDR', head) + part(b'IDAT', rows) + part(b'IEND', b'')


GREEDY = {
    'replicate': model(more='<replicate count="100000000"><geom size="1"/></replicate>'),
    'replicates in replicates': model(
        more='<replicate count="2000">' * 3 + '<geom size="1"/>' + '</replicate>' * 3
    ),
    'texture': model('<texture name="t" builtin="flat" type="2d" width="60000" height="60000"/>'),
    'height field': model('<hfield name="h" nrow="60000" ncol="60000" size="1 1 1 1"/>'),
    'memory': model(head='<size memory="1000G"/>'),
    'user data': model(head='<size nuserdata="2000000000"/>'),
    'constraints': model(head='<size njmax="2000000000"/>'),
    'numbers': model(head='<custom><numeric name="n" size="2000000000" data="1"/></custom>'),
    'attached models': model(
        '<model name="q" file="0.xml"/>', '<attach model="q" body="b" prefix="p"/>' * 20
    ),
    'flex': model(inner='<flexcomp name="f" type="grid" count="2000 2000 2000" dim="3"/>'),
    'mesh': model('<mesh name="m" builtin="sphere" params="12"/>'),
    'picture': model('<texture name="t" type="2d" file="p.png"/>'),
    'picture as height field': model('<hfield name="h" size="1 1 1 1" file="p.png"/>'),
}  # fmt: skip


@pytest.mark.parametrize(
    'kind', quick(GREEDY, 'replicate', 'attached models', 'picture', 'numbers')
)
def test_a_model_that_asks_for_too_much(kind, body_flight, tmp_path):
    files = {'m.xml': GREEDY[kind]}
    if 'picture' in kind:
        files['p.png'] = png(14000, 14000)
    for i in range(5):  # each attaches the next one twenty times
        asset = f'<model name="q" file="{i + 1}.xml"/>'
        files[f'{i}.xml'] = model(asset, '<attach model="q" body="b" prefix="p"/>' * 20)
    files['5.xml'] = model()
    log = rewritten(body_flight, tmp_path / 'bad.mcap', files=files)
    begin = time.monotonic()
    with pytest.raises(Exception, match=str(log)) as caught:
        resimulate(open_log(log))
    assert time.monotonic() - begin < 25
    line = str(caught.value)
    assert '\n' not in line and ('the limit model_' in line or 'm.xml' in line)


def test_the_limit_of_the_model_can_be_raised(body_flight, tmp_path, monkeypatch):
    asset = '<texture name="t" builtin="flat" type="2d" width="9000" height="9000"/>'
    log = rewritten(body_flight, tmp_path / 'large.mcap', files={'m.xml': model(asset)})
    monkeypatch.setenv(VARIABLE, 'model_bytes=100e6')
    with pytest.raises(Exception, match=r'model_bytes = 100000000 .*=model_bytes=NUMBER'):
        resimulate(open_log(log))
    monkeypatch.setenv(VARIABLE, 'model_bytes=1e9')
    assert resimulate(open_log(log)).difference is None


def test_a_picture_is_no_larger_than_the_film_whatever_a_model_asks_for(body_flight, tmp_path):
    """Buffers of 16384 x 16384 pixels, 4 samples and a shadow map as large would be 7 GiB."""
    size = '<global offwidth="16384" offheight="16384"/><quality shadowsize="16384"/>'
    asked = model(head=f'<visual>{size}</visual>')
    log = rewritten(body_flight, tmp_path / 'large.mcap', files={'m.xml': asked})
    action = COMMANDS['render'][1]
    action(body_flight, tmp_path)  # the libraries that draw take their memory once
    verdict = judged(lambda: action(log, tmp_path), log.stat().st_size)
    assert verdict.outcome == 'read', verdict
    assert verdict.memory < 100 << 20
