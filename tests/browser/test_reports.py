"""Reports as a browser shows them: python3 test_reports.py PDPLATE CASES FOLDER

Runs small cases and a study, opens each report.html in chromium and holds it against summary.json: no complaint of the
scripts, every plot and picture drawn, every number that stands on the page the one of the file. Exit code 77: no browser.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import browser

MISSING = 77
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
COARSE = ["--set", "discretization.spacing=0.05"]
LITTLE = ["--set", "output.every=0.003"]

CASES = {  # name: case, settings, what its page must have
    "static": ("static/central_crack_pressure.toml", COARSE, ["table:recommended", "table:comparison", "table:energy", "picture:w", "picture:von_mises", "picture:Mxy"]),
    "units": ("dynamic/hole_one_crack.toml", ["--set", "discretization.spacing=0.033", "--set", "discretization.formulation=galerkin", "--set", "analysis.method=lanczos", *LITTLE], ["plot:K1 in time", "plot:Energies", "plot:Deflection of the probes", "table:peaks", "picture:Myy"]),
    "growth": ("growth/double_torsion.toml", ["--set", "discretization.spacing=0.05", "--set", "growth.max_advances=4"], ["plot:Load against length", "picture:w"]),
    "breaking": ("growth/pressure_pulse.toml", [*COARSE, "--set", "load[0].value=2.7", "--set", "output.every=0.1"], ["plot:Length of the cracks", "picture:damage"]),
    "cases": ("static/slab_on_soil.toml", ["--set", "discretization.spacing=0.25"], ["table:envelope", "table:load_cases", "table:reactions_of_cases", "table:extremes_of_cases"]),
    "canopy": ("static/glass_canopy.toml", [], ["table:load_cases", "table:reactions_of_cases"]),
    "path": ("static/strip_snaps_through.toml", [], ["picture:w"]),
    "rib": ("static/ribbed_panel.toml", [], ["table:recommended", "picture:w"]),
    "contact": ("static/crack_faces_touch.toml", [*COARSE], ["plot:Opening of crack 0", "plot:Contact pressure of crack 0"]),
    "modes": ("dynamic/frequencies_hole_one_crack.toml", ["--set", "discretization.spacing=0.1"], ["table:frequencies", "picture:w"]),
}

STUDY = """title = "Spacing < 0.2 & \\"quoted\\" </script>"
case = "{case}"
set = ["output.fields=[\\"vtk\\"]", "discretization.formulation=galerkin"]
[[axis]]
name = "spacing"
key = "discretization.spacing"
values = [0.08, 0.06, 0.05]
[[reference]]
quantity = "K1"
tip = 0
value = 0.1926604
"""


def number(text):
    """What a number on the page says: 1.5·10⁻⁶ and −0.5 too."""
    text = text.translate(SUPERSCRIPTS).replace("·10", "e").replace(",", "")
    found = re.match(r"-?[\d.]+(e-?\d+)?", text.strip())
    return float(found[0]) if found else None


def at(summary, path):
    for key in re.split(r"[.\[\]]+", path):
        if key:
            summary = summary[int(key)] if isinstance(summary, list) else summary.get(key)
    return summary


def of_numbers(page, summary):
    """What is wrong with the numbers, and how many there are."""
    wrong, shown = [], page.having("data-from")
    for one in shown:
        there = at(summary, one["data-from"])
        if isinstance(there, (int, float)):
            if float(one["data-value"]) != there:
                wrong.append(f"{one['data-from']}: {one['data-value']} on the page, {there} in summary.json")
            factor = float(one["data-factor"] or 1)
            there /= factor
            says = number(one.text)
            text_is_itself = not re.search(r" (s|ms|min|h|B|kB|MB|GB)$", one.text)  # else in another unit
            of_error = 0.06 * float(one["data-error"] or 0) / factor  # digits stand for two of the error
            rounding = max(abs(there) * (0.05 if len(one.text) < 4 else 6e-3), of_error)
            noise = one.text in ("0", "not resolved")
            if text_is_itself and not noise and (says is None or abs(says - there) > rounding):
                wrong.append(f"{one['data-from']}: says {one.text}, is {there}")
        elif there is not None and one.text != str(there):
            wrong.append(f"{one['data-from']}: says {one.text}, is {there}")
    return wrong, len(shown)


def of_page(page, wanted):
    """What is wrong with the page itself."""
    wrong = [f"the console: {line}" for line in page.complaints]
    if page.root()["data-state"] != "drawn":
        wrong.append(f"the page is {page.root()['data-state']}: {page.text[:300]}")
    have = {f"{kind}:{one[f'data-{kind}']}" for kind in ("plot", "picture", "table") for one in page.having(f"data-{kind}")}
    wrong += [f"no {name}, only {sorted(have)}" for name in wanted if name not in have]
    for kind in ("plot", "picture"):
        wrong += [f"the {kind} {one[f'data-{kind}']} is {one['data-drawn']}" for one in page.having(f"data-{kind}") if one["data-drawn"] != "yes"]
    if page.root()["data-clipped"] != "0":
        wrong.append(f"{page.root()['data-clipped']} cells of tables reach beyond the paper")
    wrong += [f"a heading ends a sheet of paper: {heading}" for heading in page.lone_headings()]
    canvases = [one for one in page.elements if one.name == "canvas"]
    wrong += [f"a canvas is blank: {one['data-field'] or one['class'] or 'a plot'}" for one in canvases if int(one["data-colours"] or 0) < 3]
    figures = len(page.having("data-plot")) + 2 * len(page.having("data-picture"))  # a picture has a colour bar
    if len(canvases) != figures:
        wrong.append(f"{len(canvases)} canvases for {figures}")
    return wrong


def of_first_sheets(report, summary):
    """What a check needs and the first two sheets of paper lack: what governs, and all load cases with their supports."""
    wrong = []
    for size in ("A4", "letter"):
        first, second = browser.sheets(report, size)[:2]
        governing = max(summary["envelope"], key=lambda one: one["value"] * (one["quantity"] == "utilisation"))
        if not re.search(rf"of the toughness +tip {governing['tip']} +{governing['value']:.3f} ± \S+ +{governing['case']}\n", first):
            wrong.append(f"{size}: sheet 1 does not say that {governing['case']} governs")
        tables = 3  # factors, deflections and stresses, forces of the supports
        wrong += [f"{size}: sheet 2 has {found} rows of {one['name']}" for one in summary["load_cases"]
                  if (found := len(re.findall(rf"^ *{one['name']} ", second, re.MULTILINE))) != tables]
    return wrong


def run_case(program, cases, folder, name):
    case, settings, wanted = CASES[name]
    out = folder / name
    subprocess.run([program, "run", cases / case, "--out", out, "--quiet", "--threads", "1", *settings], check=True)
    wrong = []
    for origin in ("the run", "its files"):
        if origin == "its files":
            (out / "report.html").unlink()
            subprocess.run([program, "report", out], check=True)
            if name not in ("static", "breaking"):
                continue  # written all the same
        summary = json.loads((out / "summary.json").read_text())
        page = browser.Page(out / "report.html")
        about_numbers, count = of_numbers(page, summary)
        found = (of_first_sheets(out / "report.html", summary) if name == "canopy" else []) + of_page(page, wanted) + about_numbers + ([] if count > 20 else [f"only {count} numbers"])
        found += [f"no warning {text}" for text in summary["warnings"] if text not in page.text]
        wrong += [f"{name}, from {origin}: {what}" for what in found]
    return wrong


def run_study(program, cases, folder):
    out, file = folder / "study", folder / "study.toml"
    file.write_text(STUDY.format(case=(cases / "static/central_crack_pressure.toml").as_posix()))
    subprocess.run([program, "study", file, "--out", out, "--quiet", "--threads", "1"], check=True)
    page = browser.Page(out / "report.html")
    wrong = of_page(page, ["plot:Error of K1 at tip 0 against run time", "plot:Error of K1 at tip 0 against points", "table:study"])
    with open(out / "study.csv") as csv:
        names, *rows = [line.rstrip("\n").split(",") for line in csv]
    for one in page.having("data-cell"):
        name, row = re.fullmatch(r"(.*)\[(\d+)\]", one["data-cell"]).groups()
        there = rows[int(row)][names.index(name)]
        if there and abs(float(one["data-value"]) / float(there) - 1) > 1e-7 if re.fullmatch(r"-?[\d.]+(e.*)?", there) else one["data-value"] != there.strip('"'):
            wrong.append(f"{one['data-cell']}: {one['data-value']} on the page, {there} in study.csv")
    if 'Spacing < 0.2 & "quoted" </script>' not in page.text:
        wrong.append("the title is not what the study says")
    links = [one["href"] for one in page.elements if one.name == "a"]
    wrong += [f"no report behind {link}" for link in links if not (out / link).exists()] + ([] if len(links) == 3 else [f"links: {links}"])
    return [f"study: {what}" for what in wrong]


def main(program, cases, folder):
    if not browser.chromium():
        print("chromium is not installed: the reports are not looked at")
        return 1 if os.environ.get("PDPLATE_TESTS") else MISSING
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    cases = pathlib.Path(cases).resolve()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(run_case, program, cases, folder, name) for name in CASES] + [pool.submit(run_study, program, cases, folder)]
        wrong = [what for job in jobs for what in job.result()]
    print("\n".join(wrong) or f"{len(jobs)} reports are as their files say")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
