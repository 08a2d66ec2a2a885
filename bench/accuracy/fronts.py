"""Pareto fronts."""


def on_front(costs):
    """For each tuple of costs (less is better): whether no other is at least as good in all of them
    and better in one."""
    return [not any(_beats(other, own) for other in costs) for own in costs]


def _beats(a, b):
    return a != b and all(x <= y for x, y in zip(a, b))
