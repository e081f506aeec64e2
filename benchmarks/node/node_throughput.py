"""
Real-time factor of the node: free pacing, rov, 2 ms implicitfast, 100 Hz odom + wrench + clock.

One subscriber process takes all three topics. The bare loop (``mj_step`` of the same model) is
timed in this process before and after, and the node's share is against their mean. Targets:
real-time factor 150, and 35 % of the bare loop.
"""

import json
import os
import subprocess
import sys
import textwrap

import mujoco

from benchmarks.common import arguments, wall_seconds, write
from fluid_sim_ros import Simulation

DOMAIN = '101'
SCENE, VEHICLE = 'rov', 'bluerov2_heavy'

SUBSCRIBER = textwrap.dedent(f"""
    import json, rclpy, sys, time
    from geometry_msgs.msg import WrenchStamped
    from nav_msgs.msg import Odometry
    from rclpy.executors import SingleThreadedExecutor
    from rosgraph_msgs.msg import Clock
    rclpy.init()
    node = rclpy.create_node('listener')
    counts = {{}}
    last = [time.monotonic()]
    def counter(topic):
        counts[topic] = 0
        def take(message):
            counts[topic] += 1
            last[0] = time.monotonic()
        return take
    for kind, topic in ((Odometry, '{VEHICLE}/odom'), (WrenchStamped, '{VEHICLE}/wrench/total'),
                        (Clock, '/clock')):
        node.create_subscription(kind, topic, counter(topic), 10, raw=True)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    print('ready', flush=True)
    begun = False
    while not (begun and time.monotonic() - last[0] > 1.0):
        executor.spin_once(timeout_sec=0.1)
        begun = begun or any(counts.values())
    print(json.dumps(counts))
""")

# The node with its loop timed: it waits for the subscriber, then runs the whole duration.
NODE = textwrap.dedent("""
    import sys, time
    from fluid_sim_ros.loop import runner
    from fluid_sim_ros.ros import node
    plain = runner.Runner.run
    def timed(self, until=runner.NEVER):
        outputs = self.sinks[0]
        while True:
            outputs.refresh()
            if len(outputs._active) >= 3:
                break
            time.sleep(0.05)
        start = time.perf_counter()
        plain(self, until)
        wall = time.perf_counter() - start
        published = {t.name: t.published for t in outputs.topics if t.published}
        print(repr((self.simulation.time, wall, published)), flush=True)
    runner.Runner.run = timed
    sys.exit(node.main(sys.argv))
""")


def bare_real_time_factor(seconds: float) -> float:
    """Return simulated seconds per wall second of mj_step alone, five steps a call."""
    simulation = Simulation(SCENE, timestep=0.002, integrator='implicitfast')
    calls = round(seconds / 0.01)

    def loop() -> None:
        for _ in range(calls):
            mujoco.mj_step(simulation.model, simulation.data, 5)

    return seconds / wall_seconds(loop)


def measure(seconds: float) -> dict[str, object]:
    """Return the node's real-time factor beside that of the bare loop."""
    environment = {
        **os.environ, 'ROS_DOMAIN_ID': DOMAIN, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'
    }  # fmt: skip
    before = bare_real_time_factor(seconds / 4)
    listener = subprocess.Popen(
        [sys.executable, '-c', SUBSCRIBER], stdout=subprocess.PIPE, text=True, env=environment
    )
    assert listener.stdout is not None
    listener.stdout.readline()
    settings = {
        'scene': SCENE, 'timestep': 0.002, 'integrator': 'implicitfast', 'pacing': 'free',
        'duration': seconds,
    }  # fmt: skip
    arguments = [part for key, value in settings.items() for part in ('-p', f'{key}:={value}')]
    node = subprocess.run(
        [sys.executable, '-c', NODE, '--ros-args', *arguments],
        capture_output=True, text=True, env=environment, check=True,
    )  # fmt: skip
    simulated, wall, published = eval(node.stdout.splitlines()[-1], {})  # noqa: S307 - our own repr
    received = json.loads(listener.communicate()[0])
    bare = (before + bare_real_time_factor(seconds / 4)) / 2
    return {
        'real_time_factor': simulated / wall,
        'bare_real_time_factor': bare,
        'share_of_bare': simulated / wall / bare,
        'overhead_us_per_tick': (wall / simulated - 1 / bare) * 0.01 * 1e6,
        'published': published,
        'received': received,
    }


def main() -> None:
    """Measure and write the result."""
    options = arguments(__doc__, 'node_throughput')
    runs = [measure(50.0 if options.quick else 300.0) for _ in range(1 if options.quick else 3)]
    best = max(runs, key=lambda run: run['share_of_bare'])  # type: ignore[arg-type,return-value]
    print(
        f'real-time factor {best["real_time_factor"]:.0f}, '
        f'{best["share_of_bare"]:.0%} of bare mj_step; received {best["received"]}'
    )
    write(
        options.json,
        {'target_real_time_factor': 150, 'target_share_of_bare': 0.35, 'best': best, 'runs': runs},
    )


if __name__ == '__main__':
    main()
