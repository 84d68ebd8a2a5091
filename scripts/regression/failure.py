"""How scripts/regress ends other than with a verdict."""


class BadInput(Exception):
    """One line; exit status 2."""


class NoResources(Exception):
    """One line; exit status 3."""
