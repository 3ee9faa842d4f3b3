# diptych: tables of an ensemble of seeds
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

from ..._diptych import key_quantities
from ...files import key_of_band, member_folders, number_name
from ..data.panels import PANEL_NAMES
from .wording import DECIMALS, UNBROKEN, ending, fixed, number, rounded, shown_unit, suffix

NAMES = {one["key"]: one["name"] for one in key_quantities()}
MOST_CURVES = 200  # members with a drawn curve
NUMERICAL = ("grains_step", "mesh", "load_step")  # parts of u_num
AXIS_UNITS = {"": "", "%": " (%)", "°": " (°)", " d": " (d)"}


def unit_of(results, verdict):
    """The unit of the quantity of a verdict, as wording.rounded takes it."""
    key = verdict["key"]
    place = f"windows/discrete/bands/{key_of_band(key)}" if verdict["window"] else f"discrete_summary/{key}"
    return shown_unit(results.numbers, place)


def text_of(results, verdict):
    """"inclination of the band, 0–1 %"."""
    text, window = NAMES[verdict["key"]], verdict["window"]
    return f"{text}, {results.places.get(window, ('', window))[1]}" if window else text


def panel_quantities(results, verdict):
    return {p: results.quantities.get(number_name(p, verdict["key"], verdict["window"])) for p in PANEL_NAMES}


def verdict_rows(results):
    """One row per verdict: text, difference, 90 % interval, margin, pairs, verdict."""
    rows = []
    for verdict in results.record["verdicts"]:
        own_unit = unit_of(results, verdict)
        unit, decimals = ("%", 1) if verdict["relative"] else (own_unit, DECIMALS.get(own_unit, 3))
        margin = 100 * verdict["margin"] if unit == "%" else verdict["margin"]
        rows.append({
            "text": text_of(results, verdict), "relative": verdict["relative"],
            "difference": _signed(verdict["difference"]["value"], unit, decimals, ending(unit)),
            "interval": _ends(verdict["difference_90"], unit, decimals),
            "margin": "± " + number(margin) + ending(unit), "n": verdict["n"],
            "verdict": verdict["verdict"]})
    return rows


def checks(record):
    """Rows: name, samples beyond the limit, limit, "kept" or "broken", reason; the broken ones first."""
    rows = sorted(record.get("checks", []), key=lambda one: not one["broken"])
    return {"head": ["", "samples beyond", "limit", "", "beyond the limit"],
            "rows": [[one["name"], f"{len(one['broken'])} of {one['n']}", number(one["limit"], "", 2),
                      "broken" if one["broken"] else "kept", one["reason"]] for one in rows]}


def validation_table(results):
    """Errors and their uncertainty in the sense of ASME V&V 20, for quantities with a value in both panels."""
    rows, verdicts = [], {one["quantity"]: one for one in results.record["verdicts"]}
    for one in results.record.get("validation", []):
        if not one["n"]:
            continue
        verdict = verdicts[one["quantity"]]
        unit, missing = unit_of(results, verdict), one["not_known"]
        label = text_of(results, verdict) + (f" [{unit.strip()}]" if unit else "")
        factor = 100 if unit == "%" else 1
        cells = [_digits(value, factor, 3) for value in (one["S"], one["D"], one["E"]["value"])]
        uncertainties = [one["parts"][name] for name in NUMERICAL] + [one["u_input"], one["u_D"]]
        cells += [_digits(u, factor, 2) for u in uncertainties]
        cells.append(_digits(one["u_val"], factor, 2, "≥ " if missing else ""))
        cells.append(_digits(one["ratio"], 1, 2, "≤ " if missing else ""))
        rows.append([label, *cells, one["verdict"] + (f" (without {', '.join(missing)})" if missing else "")])
    return {"head": ["", ("S", "continuum"), ("D", "grains"), ("E", "S − D"), ("u_num", "grains’ step"),
                     ("u_num", "mesh"), ("u_num", "load step"), ("u_input", "parameters"), ("u_D", "samples"),
                     ("u_val", "together"), "|E| / u_val", "verdict"], "rows": rows}


def measured_table(results):
    """Errors of both panels against a measurement; None without one."""
    rows = []
    for one in results.record.get("measured", {}).get("rows", []):
        unit = suffix(one["unit"])
        cells = [_digits(one[name], 1, 3) for name in ("S", "D")] + [_digits(one["E"]["value"], 1, 3)]
        cells += [_digits(one[name], 1, 2) for name in ("u_num", "u_input", "u_S", "u_D", "u_val")]
        rows.append([f"{one['quantity']}{f' [{unit.strip()}]' if unit else ''}, {PANEL_NAMES[one['panel']].lower()}",
                     *cells, one["verdict"]])
    return {"head": ["", ("S", "panel"), ("D", "measured"), ("E", "S − D"), ("u_num", "methods"),
                     ("u_input", "parameters"), ("u_S", "samples"), ("u_D", "measurement"), ("u_val", "together"),
                     "verdict"], "rows": rows} if rows else None


def _digits(value, factor, digits, before=""):
    text = "not known" if value is None else before + number(factor * value, "", digits)
    return text.replace(" ", UNBROKEN)


def _signed(value, unit, decimals, suffix=""):
    if value is None:
        return "–"
    text = fixed(value, unit, decimals)
    return ("" if text.startswith("−") or float(text) == 0 else "+") + text + suffix


def _ends(interval, unit, decimals):
    if interval["low"] is None or interval["high"] is None:
        return "unknown"
    return f"{_signed(interval['low'], unit, decimals)} to {_signed(interval['high'], unit, decimals)}{ending(unit)}"


def captions(results):
    """[(verdict, axis label, factor of the axis, caption)] for the chart of every verdict."""
    found = {band["name"]: band["text"] for band in results.record["bands"]}
    rows = []
    for verdict in results.record["verdicts"]:
        unit, caption = unit_of(results, verdict), text_of(results, verdict)
        if verdict["window"]:
            texts = [found.get(f"{verdict['window']} {panel}", "–") for panel in PANEL_NAMES]
            caption += ". Bands found, grains: " + "; continuum: ".join(texts)
        label = NAMES[verdict["key"]] + AXIS_UNITS.get(unit, "")
        rows.append((verdict, label, 100 if unit == "%" else 1, caption + "."))
    return rows


def curve_caption(results):
    """Explains the lines in the charts of histories."""
    more = "" if len(results.record["done"]) <= MOST_CURVES else f" Curves of the first {MOST_CURVES} seeds."
    across, width = results.loading_variable, results.averaging
    width = "" if width is None else f", mean over the last {across.span(width)} of {across.word}"
    return (f" Thin: every seed{width}. Thick: mean of the seeds. Shaded: 95 % interval of this mean (Student)." + more)


def band_table(results):
    """Number of bands in every stage and window."""
    texts = {band["name"]: band["text"] for band in results.record["bands"]}
    rows = [[" ".join(words)] + [texts.get(f"{place} {p}", "–") for p in PANEL_NAMES]
            for place, words in results.places.items() if f"{place} discrete" in texts]
    return {"head": ["", "grains", "continuum"], "rows": rows}


def members(results):
    """Every seed with its state and links to its report and its messages."""
    record = results.record
    failed = {member["seed"]: member for member in record["failed"]}
    place = {seed: k for k, seed in enumerate(record["done"])}
    peaks = [results.quantities.get(f"{p}_summary peak_stress_ratio") for p in PANEL_NAMES]
    rows = []
    for seed, folder in member_folders(record).items():
        row = {"seed": seed, "log": folder + ".log", "report": None, "values": ["–", "–"]}
        if seed in place:
            row["state"] = "done"
            row["values"] = [rounded(q["values"][place[seed]], "") if q else "–" for q in peaks]
            if os.path.isfile(os.path.join(results.folder, folder, "report.html")):
                row["report"] = folder + "/report.html"
        elif seed in failed:
            row["state"] = f"failed, exit code {failed[seed]['exit_code']}: {failed[seed]['message']}"
        else:
            row["state"] = "interrupted"
        rows.append(row)
    return rows


def quantity_table(results):
    rows = [[q["name"], q["unit"], str(q["n"])]
            + ["–" if q[key] is None else number(q[key]) for key in ("mean", "deviation", "low", "high")]
            for q in results.record["quantities"]]
    return {"head": ["quantity", "unit", "n", "mean", "deviation", "95 % from", "to"], "rows": rows}


def provenance(results):
    source = results.provenance
    rows = [[words, str(source[key])] for key, words in (("program", "program"), ("version", "version"),
                                                          ("git_revision", "revision"), ("command", "command"),
                                                          ("date", "run on")) if source.get(key) is not None]
    rows += [[f"time of the {phase['name']}",
              f"{number(phase.get('wall_s'), ' s', 3)}, CPU {number(phase.get('cpu_s'), ' s', 3)}"]
             for phase in source.get("phases") or []]
    return {"head": ["", ""], "rows": rows}
