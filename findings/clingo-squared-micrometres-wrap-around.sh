#!/usr/bin/env bash
# clingo wraps numbers beyond 31 bits without a word: discs 50 mm apart have a negative squared distance.
#
# One would guess: integers of a 64-bit program hold 50000 * 50000, or a warning says that they do not.
#
# Seen with clingo 5.8.3, all warnings on: with positions in micrometres, (X-XX)**2+(Y-YY)**2 is computed in 32
# bits. 50 mm gives -1794967296, 70 mm gives 605032704 instead of 4900000000. A rule "closer than 45 mm" holds for
# discs at 50, 70 and 100 mm. A rule "80 mm or more apart" holds at 46.3 mm and fails at 100 mm, because the
# 80000**2 in it wraps as well.
#
# Why it matters: answer set programming has no reals, so scenes are scaled to integers, and micrometres are the
# natural scale of a robot cell. The first 46.3 mm are right, which is enough for the tests of a small scene.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check clingo==5.8.3
venv/bin/python - <<'PY'
import sys

import clingo


def expect(claim, holds):
    print(("as recorded: " if holds else "CHANGED: ") + claim)
    if not holds:
        sys.exit(1)


PROGRAM = """
disc(cup,0,0).  disc(a,46300,0).  disc(b,50000,0).  disc(c,70000,0).  disc(d,30000,40000).  disc(e,100000,0).
squared(D,(X-XX)**2+(Y-YY)**2) :- disc(D,X,Y), disc(cup,XX,YY), D != cup.
close(D) :- squared(D,S), S < 45000**2.
apart(D) :- squared(D,S), S >= 80000**2.
"""
TRUE = {"a": 46300**2, "b": 50000**2, "c": 70000**2, "d": 50000**2, "e": 100000**2}
messages = []
control = clingo.Control(["--warn=all"], logger=lambda code, text: messages.append(text))
control.add("base", [], PROGRAM)
control.ground([("base", [])])
squared, close, apart = {}, set(), set()


def keep(model):
    for symbol in model.symbols(atoms=True):
        if symbol.name == "squared":
            squared[symbol.arguments[0].name] = symbol.arguments[1].number
        if symbol.name == "close":
            close.add(symbol.arguments[0].name)
        if symbol.name == "apart":
            apart.add(symbol.arguments[0].name)


control.solve(on_model=keep)
print("clingo", clingo.__version__)
for disc, true in TRUE.items():
    print(f"{disc}: {true**0.5 / 1000:.1f} mm, squared {true}, in clingo {squared[disc]};"
          f" closer than 45 mm: {disc in close}, 80 mm or more apart: {disc in apart}")
expect("the values are those of 32 bits", all((s - TRUE[d]) % 2**32 == 0 for d, s in squared.items()))
expect("46.3 mm is right", squared["a"] == TRUE["a"] and "a" not in close)
expect("50, 70 and 100 mm count as closer than 45 mm", close == {"b", "c", "d", "e"})
expect("46.3 mm counts as 80 mm or more, 100 mm does not", apart == {"a"})
expect("nothing is reported", messages == [])
PY
