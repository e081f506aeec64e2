"""A flood of faults is one line per second, with a count."""

from fluid_sim_ros.ros.health import throttled_log
from fluid_sim_ros.ros.health.throttled_log import ThrottledLog


def test_a_flood_is_one_line_a_second_with_a_count(monkeypatch):
    now, lines = [100.0], []
    monkeypatch.setattr(throttled_log.time, 'monotonic', lambda: now[0])
    log = ThrottledLog(lines.append)
    for _ in range(1000):
        log('a', 'a: rejected')
    log('b', 'b: rejected')
    now[0] += 1.0
    log('a', 'a: rejected')
    now[0] += 1.0
    log('a', 'a: rejected')
    assert lines == [
        'a: rejected', 'b: rejected', 'a: rejected (999 more like it before)', 'a: rejected'
    ]  # fmt: skip
