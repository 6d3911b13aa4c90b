class Failure(Exception):
    """Why there is no plan, in words for an operator."""
