# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile robots: URDF, xacro and MJCF as they are imported."""

from random import Random

from test.support.hostile import values
from test.support.hostile.foreign.meshes import BILLION, outside_entity

KINDS = ('urdf', 'xacro', 'mjcf')
_URDF = """<robot name="my-rov"{space}>
  <link name="base"><inertial><origin xyz="0 0 -0.02"/><mass value="30"/><inertia ixx="0.2" ixy="0"
    ixz="0" iyy="0.3" iyz="0" izz="0.4"/></inertial>
    <collision><geometry><box size="0.5 0.3 0.2"/></geometry></collision></link>
  <link name="screw"><visual><geometry><cylinder radius="0.1" length="0.02"/></geometry></visual>
  </link>
  <joint name="shaft" type="continuous"><parent link="base"/><child link="screw"/>
    <origin xyz="-0.3 0 0" rpy="0 0 3.14"/><axis xyz="-1 0 0"/></joint>
  {more}
</robot>"""
_MJCF = """<mujoco><compiler/><asset>{asset}</asset><worldbody><body name="hull" pos="0 0 1">
<freejoint/><geom name="g" type="box" size="0.2 0.1 0.1" mass="3"/>{more}
<body name="fin" pos="-0.2 0 0"><joint name="j" type="hinge" range="-1 1"/>
<geom type="capsule" size="0.01 0.1" mass="0.1"/></body></body></worldbody></mujoco>"""
_CODE = (
    "__import__('os').system('touch {made}')", "open('{made}', 'w').write('x')",
    "open('{outside}').read()", "().__class__.__base__.__subclasses__()",
    "[c for c in ().__class__.__mro__[1].__subclasses__()]", "xacro.load_yaml('{outside}')",
    "load_yaml('{outside}')", "'a' * 10**10", '10**10**7', '2**2**2**2**2**2',
    'list(range(10**9))',
    "eval('1')", "exec('1')", "globals()", "__builtins__", "xacro.__init__.__globals__",
    "'{{0.__class__.__mro__}}'.format(1)", 'lambda: 1', '[[x for x in range(10**4)] '
    'for y in range(10**4)]', 'sum(range(10**8))', 'math.factorial(10**6)', "f'{{1:1000000000}}'",
    "print_location()", "xacro.arg('x')", "tokenize('{outside}')", "'%1000000000d' % 1",
    "(lambda f: f(f))(lambda f: f(f))", "abs.__self__.open('{outside}').read()", "1/0", "[", "''",
    "python.open('{outside}')", "str.__class__.mro(str)[1].__subclasses__(str)",
    "dict.__getitem__", "xacro.message('x' * 10**8)", "xacro.fatal('x')",
)  # fmt: skip
_SUBSTITUTED = (
    "$(eval open('{outside}').read())", "$(eval __import__('os').system('touch {made}'))",
    '$(find ../..)', '$(find std_msgs)', '$(env HOME)', '$(optenv HOME x)', '$(dirname)', '$(cwd)',
    '$(arg x)', '$(anon x)', '$(find x', '$(command touch {made})', '$(eval 10**10**7)',
    '$(eval "a" * 10**10)',
)  # fmt: skip
_XACRO = (
    '<xacro:include filename="{outside}"/>', '<xacro:include filename="../../../etc/passwd"/>',
    '<xacro:include filename="a.xacro"/>', '<xacro:include filename="/dev/zero"/>',
    '<xacro:include filename="*"/>', '<xacro:include filename="/etc/*"/>',
    '<xacro:macro name="m"><xacro:m/><xacro:m/></xacro:macro><xacro:m/>',
    '<xacro:property name="a" value="${{a}}"/><link name="${{a}}"/>',
    '<xacro:property name="a" value="${{b}}"/><xacro:property name="b" value="${{a}}"/>'
    '<link name="${{a}}"/>',
    '<xacro:property name="a" value="{outside}"/><xacro:include filename="${{a}}"/>',
    '<xacro:arg name="x" default="$(arg x)"/>', '<xacro:if value="${{x"/>',
    '<xacro:call macro="${{1}}"/>', '<xacro:element xacro:name="${{5}}"/>', '<xacro:zzz/>',
    '<xacro:insert_block name="*"/>', '<xacro:attribute name="a" value="b"/>',
    '<xacro:macro name="m" params="a:=^ *b **c"/><xacro:m/>',
    '<xacro:property name="y" value="${{xacro.load_yaml(\'{outside}\')}}"/><link name="${{y}}"/>',
)  # fmt: skip
_MORE = (
    '<link name="a"><visual><geometry><mesh filename="{outside}"/></geometry></visual></link>',
    '<link name="a"><visual><geometry><mesh filename="file://{outside}"/></geometry></visual></link>',
    '<link name="a"><visual><geometry><mesh filename="package://../{outside}"/></geometry></visual>'
    '</link>',
    '<link name="a"><visual><geometry><mesh filename="http://127.0.0.1:9/a.stl"/></geometry>'
    '</visual></link>',
    '<link name="base"/>',
    '<joint name="k" type="fixed"><parent link="screw"/><child link="base"/></joint>',
    '<joint name="k" type="planar"/>', '<joint/>', '<link/>', '<mujoco><include file="{outside}"/>'
    '</mujoco>',
    '<mujoco><compiler meshdir="/etc"/></mujoco>', '<gazebo>' * 900 + '</gazebo>' * 900,
    '<x>' * 5000 + '</x>' * 5000, '<link name="a"/>' * 5000, '<transmission/>', '<sensor/>',
    '<joint name="k" type="revolute"><parent link="base"/><child link="a"/><mimic joint="k"/>'
    '</joint><link name="a"/>',
)  # fmt: skip
_ASSETS = (
    '<mesh name="m" file="{outside}"/>', '<texture name="t" file="{outside}" type="2d"/>',
    '<texture name="t" builtin="flat" width="60000" height="60000" type="2d"/>',
    '<hfield name="h" file="{outside}" size="1 1 1 1"/>', '<model name="x" file="{outside}"/>',
    '<hfield name="h" nrow="30000" ncol="30000" size="1 1 1 1"/>', '<mesh name="m" file="m.stl"/>',
    '<skin name="s" file="{outside}"/>', '<include file="{outside}"/>', '<include file="a.xml"/>',
    '<include file="/dev/zero"/>', '<mesh name="m" builtin="sphere" params="9"/>',
)  # fmt: skip
_PARTS = (
    '<replicate count="100000000" offset="1 0 0"><geom size="1"/></replicate>',
    '<composite type="cable" count="10000000 1 1" size="1"/>',
    '<frame>' * 2000 + '</frame>' * 2000, '<flexcomp name="f" type="grid" count="900 900 900"/>',
    '<attach model="x" body="y" prefix=""/>',
    '<geom type="mesh" mesh="m"/>', '<geom size="1e308"/>', '<geom size="nan" mass="1"/>',
    '<plugin plugin="fluid_sim.body"/>', '<plugin plugin="mujoco.elasticity.cable"/>',
    '<body/>' * 20_000, '<inertial pos="0 0 0" mass="1e308" diaginertia="1 1 1"/>',
)  # fmt: skip


def hostile_robot(kind: str, random: Random, outside: str) -> bytes:
    """
    Return a hostile file.

    Parameters
    ----------
    kind
        One of ``KINDS``.
    random
        Source of choices.
    outside
        Path of a file that must not be read; one beside it with ``.made`` must not be made.

    """
    names = {'outside': outside, 'made': outside + '.made'}

    def one(choices: tuple[str, ...]) -> str:
        return random.choice(choices).replace('{{', '{').replace('}}', '}').replace(
            '{outside}', names['outside']
        ).replace('{made}', names['made'])  # fmt: skip

    if kind == 'mjcf':
        asset = one(_ASSETS) if random.random() < 0.5 else ''
        text = _MJCF.format(asset=asset, more=one(_PARTS) if random.random() < 0.5 else '')
    else:
        space = ' xmlns:xacro="http://www.ros.org/wiki/xacro"' if kind == 'xacro' else ''
        more = one(_MORE) if random.random() < 0.4 else ''
        if kind == 'xacro':
            code = one(_CODE).replace('"', '&quot;').replace('<', '&lt;')
            more = random.choice((
                f'<link name="${{{code}}}"/>', f'<xacro:if value="${{{code}}}"><link/></xacro:if>',
                f'<xacro:property name="p" value="${{{code}}}"/><link name="${{p}}"/>',
                f'<link name="{one(_SUBSTITUTED).replace(chr(34), "&quot;")}"/>', one(_XACRO),
                one(_XACRO) + more, more,
            ))  # fmt: skip
        text = _URDF.format(space=space, more=more)
    if random.random() < 0.15:
        text = random.choice((BILLION, outside_entity(outside))) + text.replace(
            random.choice(('my-rov', 'base', 'hull')), '&j;', 1
        )
    for _ in range(random.choice((0, 0, 1, 2))):
        at = text.find('"', random.randrange(len(text)))
        end = text.find('"', at + 1)
        made = random.choice((values.text(random)[:500], str(values.number(random)), '', 'base'))
        if 0 <= at < end:
            text = text[: at + 1] + made.replace('"', '').replace('<', '') + text[end:]
    data = text.encode(random.choice(('utf-8', 'utf-8', 'utf-8', 'utf-16')), 'replace')
    return values.damaged(random, data) if random.random() < 0.1 else data
