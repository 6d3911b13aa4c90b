"""OR-tools CP-SAT: booleans for objects and options, and levels against cycles.

A relocated object has a chosen option, and all members of a chosen option are relocated. Within a strongly connected
component, and only there, a chosen option's members stand on lower levels than its object.
"""

from ortools.sat.python import cp_model
from serve import Answer, Base, serve

# One worker beat the default (one a core) on every class when both were tried.
HOW: dict[str, dict[str, bool]] = {
    "no presolve": {"cp_model_presolve": False},
    "core": {"optimize_with_core": True},
    "default": {},
}


def solve(base: Base, how: str) -> Answer:
    """The least count."""
    model, relocated = build(base)
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    for parameter, value in HOW[how].items():
        setattr(solver.parameters, parameter, value)
    status = solver.solve(model)
    if status == cp_model.INFEASIBLE:
        return Answer(None, solver.wall_time)
    if status != cp_model.OPTIMAL:
        raise RuntimeError(solver.status_name(status))
    return Answer(sum(solver.boolean_value(variable) for variable in relocated), solver.wall_time)


def build(base: Base) -> tuple[cp_model.CpModel, list[cp_model.IntVar]]:
    """The model, and its variables for the objects other than the target."""
    # Nothing derives itself.
    options = [[option for option in of if at not in option] for at, of in enumerate(base.usable())]
    component = components([{member for option in of for member in option} for of in options])
    sizes = [0] * len(options)
    for number in component:
        sizes[number] += 1
    model = cp_model.CpModel()
    relocated = [model.new_bool_var("") for _ in options]
    levels = [model.new_int_var(0, sizes[number] - 1, "") if sizes[number] > 1 else None for number in component]
    model.add_bool_and(relocated[base.target])
    for at, of_object in enumerate(options):
        if [] in of_object:
            continue
        chosen = [model.new_bool_var("") for _ in of_object]
        model.add_bool_or([*chosen, ~relocated[at]])
        for variable, option in zip(chosen, of_object, strict=True):
            model.add_bool_and([relocated[member] for member in option]).only_enforce_if(variable)
            for member in option:
                if component[member] == component[at]:
                    model.add(levels[at] >= levels[member] + 1).only_enforce_if(variable)
    others = [variable for at, variable in enumerate(relocated) if at != base.target]
    model.minimize(sum(others))
    return model, others


def components(successors: list[set[int]]) -> list[int]:
    """The strongly connected component of each node (Tarjan, without recursion)."""
    index = [-1] * len(successors)
    low = [0] * len(successors)
    component = [-1] * len(successors)
    stack: list[int] = []
    reached = found = 0
    for root in range(len(successors)):
        if index[root] >= 0:
            continue
        path = [(root, iter(successors[root]))]
        index[root] = low[root] = reached
        reached += 1
        stack.append(root)
        while path:
            node, rest = path[-1]
            following = next(rest, None)
            if following is None:
                path.pop()
                if path:
                    low[path[-1][0]] = min(low[path[-1][0]], low[node])
                if low[node] == index[node]:
                    while component[node] < 0:
                        component[stack.pop()] = found
                    found += 1
            elif index[following] < 0:
                index[following] = low[following] = reached
                reached += 1
                stack.append(following)
                path.append((following, iter(successors[following])))
            elif component[following] < 0:
                low[node] = min(low[node], index[following])
    return component


if __name__ == "__main__":
    serve(solve)
