# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Takes a node through its lifecycle many times, as a process, and says what it holds."""

import ctypes
import gc
import json
import os
import sys
import threading
from pathlib import Path

import rclpy
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.signals import SignalHandlerOptions

from fluid_sim_ros.ros.node import FluidSimNode
from fluid_sim_ros.ros.process.run import executor_thread

_PAGE_KB = os.sysconf('SC_PAGE_SIZE') / 1024


class _Allocated(ctypes.Structure):
    """What glibc's ``mallinfo2`` returns."""

    _fields_ = [
        (name, ctypes.c_size_t)
        for name in (
            'arena', 'ordblks', 'smblks', 'hblks', 'hblkhd', 'usmblks', 'fsmblks', 'uordblks',
            'fordblks', 'keepcost',
        )
    ]  # fmt: skip


def held():
    """Return what this process holds: objects, bytes allocated and resident [kB], handles."""
    gc.collect()
    ask = ctypes.CDLL(None).mallinfo2
    ask.restype = _Allocated
    allocated = ask()
    return {
        'objects': len(gc.get_objects()),
        'allocated_kb': (allocated.uordblks + allocated.hblkhd) / 1024,
        'resident_kb': int(Path('/proc/self/statm').read_text().split()[1]) * _PAGE_KB,
        'handles': len(list(Path('/proc/self/fd').iterdir())),
        'threads': threading.active_count(),
    }


def main(warm_up, cycles, scene):
    """Print what is held after the warm-up, and after so many more cycles."""
    rclpy.init(
        args=['node', '--ros-args', '-p', 'autostart:=false', '-p', f'scene:={scene}'],
        signal_handler_options=SignalHandlerOptions.NO,
    )
    node = FluidSimNode()

    def drive():
        try:
            for count in (warm_up, cycles):
                for _ in range(count):
                    assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS
                    node.trigger_activate()
                    node.trigger_deactivate()
                    assert node.trigger_cleanup() == TransitionCallbackReturn.SUCCESS
                sys.stdout.write(json.dumps(held()) + '\n')
        finally:
            node.end()

    with executor_thread(node):
        driver = threading.Thread(target=drive)
        driver.start()
        node.run()
        driver.join()
        node.close()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
