"""What a case consists of, in tables, and what to try where a run failed."""

from __future__ import annotations

import re
from collections.abc import Iterable

from report_units import Units

AXES = "xyz"


def number(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, (int, float)) else str(value)


def curve(value: object) -> str:
    """A constant, or what a load curve goes through."""
    if not isinstance(value, dict):
        return number(value)
    if "times" not in value or "values" not in value:
        return str(value)
    times, values = value["times"], value["values"]
    if len(times) <= 3:
        return ", ".join(f"{number(v)} at t = {number(t)}"
                         for t, v in zip(times, values))
    return (f"between {number(min(values))} and {number(max(values))}, "
            f"{len(times)} points from t = {number(times[0])} to "
            f"{number(times[-1])}")


def components(values: Iterable) -> str:
    """What is prescribed of a vector; zeros together."""
    named = list(zip(AXES, values))
    zero = "".join(axis for axis, value in named if value == 0
                   and not isinstance(value, bool))
    parts = [f"{zero}: 0"] if zero else []
    parts += [f"{axis}: {curve(value)}" for axis, value in named
              if axis not in zero and value != "free"]
    return "; ".join(parts)


def solid_columns(solid: dict) -> tuple[str, ...]:
    """Law, moduli and Poisson's ratios; those of the parts of a mixture."""
    parts = [solid_columns(part) for part in solid.get("solids", ())]
    if parts:
        return tuple("; ".join(filter(None, column)) for column in zip(*parts))
    values = {name: number(value) for name, value in solid.items()
              if name != "model"}
    named = [[f"{name} = {value}" for name, value in values.items()
              if name.startswith("nu") == ratio] for ratio in (False, True)]
    return (str(solid.get("model", "")).replace("_", " "),
            *(", ".join(column) for column in named))


def material_rows(case: dict) -> list[tuple[str, ...]]:
    rows = []
    for material in case.get("material", ()):
        flow = dict(material.get("permeability", {}))
        law = flow.pop("model", "constant")
        values = [number(flow.pop("value"))] if "value" in flow else []
        values += [f"{name} = {number(value)}" for name, value in flow.items()]
        if law != "constant":
            values.insert(0, str(law).replace("_", " "))
        rows.append((", ".join(material.get("regions", ())),
                     *solid_columns(material.get("solid", {})),
                     ", ".join(values),
                     number(material.get("solid_fraction", ""))))
    return rows


def material_headings(units: Units) -> list[str]:
    return ["Region", "Solid", units.label("Moduli", "pressure"),
            "Poisson's ratios", units.label("Permeability", "permeability"),
            "Solid fraction"]


def condition_rows(case: dict, units: Units) -> list[tuple[str, str, str]]:
    """Surfaces, and what holds or loads them."""
    rows = []
    for boundary in case.get("boundary", ()):
        where = ", ".join(boundary.get("surfaces", ()))

        def add(what: str, kind: str, value: str, where: str = where) -> None:
            if value:
                rows.append((where, units.label(what, kind), value))

        for what, kind in (("displacement", "length"),
                           ("traction", "pressure")):
            value = boundary.get(what)
            if value is not None:
                add(what, kind, components(value) if isinstance(value, list)
                    else curve(value))
        for key, what, kind in (
                ("pressure", "fluid pressure", "pressure"),
                ("normal_traction", "normal traction", "pressure"),
                ("effective_traction", "effective traction", "pressure"),
                ("mixture_flux", "flux of the mixture", "velocity"),
                ("normal_flux", "normal flux", "velocity")):
            if key in boundary:
                add(what, kind, curve(boundary[key]))
        if boundary.get("sealed"):
            rows.append((where, "fluid", "passes nowhere"))
        spring = boundary.get("spring", {})
        if spring.get("stiffness"):
            add("springs", "stiffness", number(spring["stiffness"])
                + along(spring.get("direction", ())))
        force = boundary.get("force", {})
        if "curve" in force:
            add("force", "force", curve(force["curve"])
                + along(force.get("direction", ())))
    return rows


def along(direction: Iterable[float]) -> str:
    vector = list(direction)
    if not any(vector):
        return ""
    return f", along ({', '.join(number(v) for v in vector)})"


CONDITION_HEADINGS = ("Surfaces", "Quantity", "Value")
CONTACT_HEADINGS = ("Pair", "Source", "Destination", "Search on surfaces")


def contact_rows(case: dict) -> list[tuple[str, ...]]:
    rows = []
    for contact in case.get("contact", ()):
        search = "as deformed" \
            if contact.get("configuration") == "current" else "as meshed"
        rows.append((contact.get("name", ""),
                     ", ".join(contact.get("source", ())),
                     ", ".join(contact.get("destination", ())), search))
    return rows


def numerics_rows(case: dict, units: Units) -> list[tuple[str, str]]:
    """Mesh, order, time steps and solver."""
    rows = []
    mesh, time = case.get("mesh", {}), case.get("time", {})
    if "file" in mesh:
        changes = [f"{key} {number(mesh[key])}"
                   for key, usual in (("scale", 1), ("refine", 0))
                   if mesh.get(key, usual) != usual]
        rows.append(("Mesh", ", ".join([str(mesh["file"]), *changes])))
    if "order" in case.get("space", {}):
        rows.append(("Order of the displacement",
                     number(case["space"]["order"])))
    if "deformation" in case.get("physics", {}):
        rows.append(("Deformation", case["physics"]["deformation"]))
    for key, name in (("end", "End"), ("step", "Time step")):
        if key in time:
            text = number(time[key])
            if key == "step" and time.get("adaptive"):
                text += " at first, then adaptive"
            rows.append((units.label(name, "time"), text))
    if "scheme" in time:
        rows.append(("Time scheme", str(time["scheme"]).replace("_", " ")))
    if "linear" in case.get("solver", {}):
        rows.append(("Linear solver", str(case["solver"]["linear"])))
    return rows


# What helps, by what the error says. The first group that fits is given.
REMEDIES = (
    (r"nothing resists|held by nothing|free to move|would move by",
     ("Hold the body that it names: a displacement, springs, or contact that "
      "touches from the start.",)),
    (r"[Nn]o space left|cannot write",
     ("Make room, or write elsewhere with --output; go on with --resume.",)),
    (r"overlap",
     ("Move the bodies apart in the mesh, or measure gaps from the overlap: "
      "initial_overlap = \"remove\" of the pair.",)),
    (r"linear solver did not converge|singular|factori[sz]ation",
     ("Solve with a factorization, where memory allows: --set "
      "'solver.linear=\"direct\"'.",
      "See that each body is held, and that stiffness and permeability are in "
      "the units of the mesh.")),
    (r"augmentations|active set|Newton|finite number|failed: ",
     ("Begin with shorter steps: --set time.step={step}, or let them adapt: "
      "--set time.adaptive=true.",
      "See that loads begin at zero and that the bodies touch, or nearly so, "
      "as meshed.",
      "Where contact surfaces are much coarser than the contact, refine "
      "them.")))


def remedies(errors: list[str], case: dict) -> list[str]:
    """What to try, the most likely first."""
    found = ["synovia CASE.toml --check lists what looks like a mistake: "
             "units, names, supports, gaps."]
    step = case.get("time", {}).get("step", 0)
    for pattern, texts in REMEDIES:
        if any(re.search(pattern, error) for error in errors):
            found[:0] = [text.replace("{step}", number(step / 10))
                         if step else text.replace("={step}", "=...")
                         for text in texts]
            break
    return found
