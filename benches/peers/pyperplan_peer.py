"""pyperplan: delete-free STRIPS in PDDL, A* with LM-cut.

One action an option, with the relocated members as its precondition; the goal is that the target is grasped. A plan's
last action grasps the target, so it has one more step than relocations.
"""

from time import perf_counter

from pyperplan.grounding import ground
from pyperplan.heuristics.lm_cut import LmCutHeuristic
from pyperplan.pddl.parser import Parser
from pyperplan.search import astar_search
from serve import Answer, Base, serve

HOW = ["lmcut"]


def solve(base: Base, how: str) -> Answer:
    """The least count."""
    assert how in HOW
    parser = Parser(None)
    parser.domInput, parser.probInput = domain(base), problem(base)
    task = ground(parser.parse_problem(parser.parse_domain(read_from_file=False), read_from_file=False))
    started = perf_counter()
    plan = astar_search(task, LmCutHeuristic(task))
    return Answer(None if plan is None else len(plan) - 1, perf_counter() - started)


def domain(base: Base) -> str:
    """The actions."""
    atoms = " ".join(f"(moved-{at})" for at in range(len(base.options)))
    actions = [
        f"(:action move-{at}-{number} :parameters ()"
        f" :precondition (and (ready) {' '.join(f'(moved-{member})' for member in option)})"
        f" :effect (and (moved-{at})))"
        for at, options in enumerate(base.usable())
        for number, option in enumerate(options)
    ]
    return f"(define (domain table) (:requirements :strips) (:predicates (ready) {atoms}) {' '.join(actions)})"


def problem(base: Base) -> str:
    """Nothing has moved; the target is wanted."""
    return f"(define (problem free) (:domain table) (:init (ready)) (:goal (and (moved-{base.target}))))"


if __name__ == "__main__":
    serve(solve)
