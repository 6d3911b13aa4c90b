"""clingo: one ground rule an option.

`{rel(j)} :- rel(a), rel(b).` for each option {a, b} of each object j: an object may be relocated when one of its
options is, and never because of itself, since answer sets are founded. The count of `rel` is minimised. The rules are
handed over in clingo's format for ground programs (aspif): faster than `Backend`, and far faster than text that has to
be grounded.
"""

from time import perf_counter

import clingo
from serve import Answer, Base, serve

HOW = {"usc,disjoint": ["--opt-strategy=usc,oll,1"], "usc": ["--opt-strategy=usc"], "default": []}


def solve(base: Base, how: str) -> Answer:
    """The least count, or how many objects can be derived where there is no target."""
    control = clingo.Control(HOW[how])
    control.add("base", [], program(base))
    control.ground([("base", [])])
    optimum: int | None = None

    def note(model: clingo.Model) -> None:
        nonlocal optimum
        if base.target is None:
            optimum = sum(model.is_true(at + 1) for at in range(len(base.options)))
        else:
            optimum = sum(model.cost)

    started = perf_counter()
    control.solve(on_model=note)
    return Answer(optimum, perf_counter() - started)


def program(base: Base) -> str:
    """Atom n + 1 says that object n is relocated; one more that the target is free. Without a target nothing is chosen:
    whatever can be derived is."""
    options = base.usable()
    free = len(options) + 1
    choice = 0 if base.target is None else 1
    lines = ["asp 1 0 0"]
    for at, of_object in enumerate(options):
        head = f"1 0 1 {free} 0" if at == base.target else f"1 {choice} 1 {at + 1} 0"
        lines += [f"{head} {len(option)}{''.join([f' {member + 1}' for member in option])}" for option in of_object]
    if base.target is not None:
        movable = [at + 1 for at, of_object in enumerate(options) if of_object and at != base.target]
        lines.append(f"1 0 0 0 1 -{free}")
        lines.append(f"2 0 {len(movable)}{''.join([f' {atom} 1' for atom in movable])}")
    return "\n".join([*lines, "0\n"])


if __name__ == "__main__":
    serve(solve)
