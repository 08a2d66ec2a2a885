"""The one error of a codestream that cannot be decoded."""


class CodestreamError(Exception):
    """The codestream is damaged or has a shape that was not asked for."""


def demand(condition, reason):
    """Raises CodestreamError unless the condition holds."""
    if not condition:
        raise CodestreamError(reason)
