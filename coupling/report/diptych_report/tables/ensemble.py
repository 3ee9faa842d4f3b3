#!/usr/bin/env python3
# diptych: report.html of an ensemble of seeds; usage: ensemble.py ENSEMBLE_DIR
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exit codes: 0 done, 2 wrong input (usage, missing or broken file). An old page stays until the new one is whole."""

import os
import sys

sys.dont_write_bytecode = True  # the source tree may be read-only, and stays clean

import jinja2  # noqa: E402

import ensemble_figures as figures  # noqa: E402
import style  # noqa: E402
from ensemble_load import MOST_HISTORIES, load  # noqa: E402
from load import InputError  # noqa: E402
from wording import DECIMALS, number, origin, rounded  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
PANELS = ("discrete", "continuum")
# key -> (words, unit of wording.rounded, decimals of its difference)
KEYS = {"peak_stress_ratio": ("peak stress ratio t/s", ""), "final_volumetric_strain": ("volumetric strain at the end", "%"),
        "angle_deg": ("inclination of the band", "°"), "width_10_90_d": ("10–90 % width of the band", " d")}
AXIS_UNITS = {"": "", "%": " (%)", "°": " (°)", " d": " (d)"}


def place_of(verdict):
    """("window 0-0.01", "angle_deg") or ("", "peak_stress_ratio")."""
    words = verdict["quantity"].split(" band ")
    return (words[0], words[1]) if len(words) == 2 else ("", words[0])


def words_of(results, verdict):
    """"inclination of the band, 0–1 %"."""
    place, key = place_of(verdict)
    text = KEYS.get(key, (key, ""))[0]
    if not place:
        return text
    return f"{text}, {results.place(place)[1]}"


def panel_quantities(results, verdict):
    place, key = place_of(verdict)
    names = {p: f"{place} {p} band {key}" if place else f"{p}_summary {key}" for p in PANELS}
    return {p: results.quantity(name) for p, name in names.items()}


def with_interval(record, unit):
    """"16.9 [14.7, 19.1] d": the unit once, so that columns stay narrow."""
    if record is None or record["mean"] is None:
        return "–"
    text = _plain(record["mean"], unit)
    if record["low"] is not None and record["high"] is not None:
        text += f" [{_plain(record['low'], unit)}, {_plain(record['high'], unit)}]"
    return text + _suffix(unit)


def _plain(value, unit, decimals=None):
    decimals = DECIMALS[unit] if decimals is None else decimals
    value = round(100 * value if unit == "%" else value, decimals) + 0.0  # no minus before a zero
    return f"{value:.{decimals}f}".replace("-", "−")


def _suffix(unit):
    return {"%": "\u00a0%", " d": "\u00a0d"}.get(unit, unit)


def verdict_rows(results):
    """One row of the first table a verdict: words, means, difference, intervals, margin, pairs, verdict."""
    rows = []
    for verdict in results.record["verdicts"]:
        own_unit = KEYS.get(place_of(verdict)[1], ("", ""))[1]
        unit, decimals = ("%", 1) if verdict["relative"] else (own_unit, DECIMALS[own_unit])
        means = panel_quantities(results, verdict)
        margin = 100 * verdict["margin"] if unit == "%" else verdict["margin"]
        rows.append({
            "words": words_of(results, verdict), "relative": verdict["relative"],
            "means": [with_interval(means[p], own_unit) for p in PANELS],
            "difference": _signed(verdict["difference"]["value"], unit, decimals, _suffix(unit)),
            "intervals": [_ends(verdict[key], unit, decimals) for key in ("difference_90", "difference")],
            "margin": "± " + number(margin) + _suffix(unit), "n": verdict["n"], "verdict": verdict["verdict"]})
    return rows


def _signed(value, unit, decimals, suffix=""):
    if value is None:
        return "–"
    text = _plain(value, unit, decimals)
    return ("" if text.startswith("−") or float(text) == 0 else "+") + text + suffix


def _ends(interval, unit, decimals):
    if interval["low"] is None or interval["high"] is None:
        return "not known"
    return f"{_signed(interval['low'], unit, decimals)} to {_signed(interval['high'], unit, decimals)}{_suffix(unit)}"


def pictures(results):
    """[(picture or None, caption)] of every verdict's seeds."""
    found = {band["name"]: band["text"] for band in results.record["bands"]}
    drawn = []
    for verdict in results.record["verdicts"]:
        place, key = place_of(verdict)
        words, unit = KEYS.get(key, (key, ""))
        caption = words_of(results, verdict)
        if place:
            caption += ". Bands found, grains: " + "; continuum: ".join(found.get(f"{place} {p}", "–") for p in PANELS)
        drawn.append((figures.dots(verdict, panel_quantities(results, verdict), words + AXIS_UNITS[unit]), caption + "."))
    return drawn


def histories(results):
    more = "" if len(results.record["done"]) <= MOST_HISTORIES else f" Curves of the first {MOST_HISTORIES} seeds."
    last = f"{results.span(results.averaging)} of {results.progress.word}"
    how = (f" Thin: every seed, mean over the last {last}; thick: mean of the seeds; shaded: 95 % interval of that mean "
           "(Student)." + more)
    return [(figures.curves(results, "stress_ratio", "stress ratio t/s"), "Stress ratio of the whole sample." + how),
            (figures.curves(results, "volumetric_strain", "volumetric strain (%)", 100),
             "Volumetric strain 1 − V/V₀; dilation is negative." + how)]


def band_table(results):
    """Where how many bands were found."""
    texts = {band["name"]: band["text"] for band in results.record["bands"]}
    places = [name.removesuffix(" discrete") for name in texts if name.endswith(" discrete")]
    rows = [[" ".join(results.place(place))] + [texts.get(f"{place} {p}", "–") for p in PANELS] for place in places]
    return {"head": ["", "grains", "continuum"], "rows": rows}


def members(results):
    """Every seed: what became of it, with links to its report and its output."""
    record = results.record
    failed = {member["seed"]: member for member in record["failed"]}
    place = {seed: k for k, seed in enumerate(record["done"])}
    peaks = [results.quantity(f"{p}_summary peak_stress_ratio") for p in PANELS]
    rows = []
    for seed in record["seeds"]:
        row = {"seed": seed, "log": f"seed_{seed}.log", "report": None, "values": ["–", "–"]}
        if seed in place:
            row["state"] = "done"
            row["values"] = [rounded(q["values"][place[seed]], "") if q else "–" for q in peaks]
            if os.path.isfile(os.path.join(results.folder, f"seed_{seed}", "report.html")):
                row["report"] = f"seed_{seed}/report.html"
        elif seed in failed:
            row["state"] = f"failed, exit code {failed[seed]['exit_code']}: {failed[seed]['message']}"
        else:
            row["state"] = "interrupted"
        rows.append(row)
    return rows


def quantity_table(results):
    rows = [[q["name"], q["unit"], str(q["n"])] + ["–" if q[key] is None else number(q[key]) for key in
                                                   ("mean", "deviation", "low", "high")] for q in results.record["quantities"]]
    return {"head": ["quantity", "unit", "n", "mean", "deviation", "95 % from", "to"], "rows": rows}


def provenance(results):
    source = results.provenance
    rows = [[words, str(source[key])] for key, words in (("program", "program"), ("version", "version"),
                                                          ("git_revision", "revision"), ("command", "command"),
                                                          ("date", "run on")) if source.get(key) is not None]
    rows += [[f"time of the {phase['name']}", f"{number(phase.get('wall_s'), ' s', 3)}, CPU {number(phase.get('cpu_s'), ' s', 3)}"]
             for phase in source.get("phases") or []]
    return {"head": ["", ""], "rows": rows}


def page(results):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    rows = verdict_rows(results)
    labelled = [(row["words"], verdict) for row, verdict in zip(rows, results.record["verdicts"])]
    return environment.get_template("ensemble.html").render(
        record=results.record, verdicts=rows, differences=figures.differences(labelled), dots=pictures(results),
        curves=histories(results), bands=band_table(results), members=members(results), quantities=quantity_table(results),
        provenance=provenance(results), fitted=origin(results.scene.get("comparison/parameters_from")))


def main(arguments):
    if len(arguments) != 1:
        print("usage: ensemble.py ENSEMBLE_DIR", file=sys.stderr)
        return 2
    try:
        results = load(arguments[0])
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    style.set_up()
    text = page(results)
    path = os.path.join(arguments[0], "report.html")
    with open(path + ".part", "w", encoding="utf-8") as stream:
        stream.write(text)
    os.replace(path + ".part", path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
