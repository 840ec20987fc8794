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
PAPERS = ("A4", "letter")
CONTRAST = 4.5  # of letters, as WCAG asks for; 6.2 light, 7.6 dark
LITTLE = ["--set", "output.every=0.003"]

CASES = {  # name: case, settings, what its page must have
    "static": ("static/central_crack_pressure.toml", COARSE, ["table:recommended", "table:comparison", "table:energy", "picture:w", "picture:von_mises", "picture:Mxy"]),
    "units": ("dynamic/hole_one_crack.toml", ["--set", "discretization.spacing=0.033", "--set", "discretization.formulation=galerkin", "--set", "analysis.method=lanczos", *LITTLE], ["plot:K1 in time", "plot:Energies", "plot:Deflection of the probes", "table:peaks", "picture:Myy"]),
    "growth": ("growth/double_torsion.toml", ["--set", "discretization.spacing=0.05", "--set", "growth.max_advances=4"], ["plot:Load against length", "picture:w"]),
    "breaking": ("growth/pressure_pulse.toml", [*COARSE, "--set", "load[0].value=2.7", "--set", "output.every=0.1"], ["plot:Length of the cracks", "picture:damage"]),
    "cases": ("static/slab_on_soil.toml", ["--set", "discretization.spacing=0.25"], ["table:envelope", "table:load_cases", "table:reactions_of_cases", "table:extremes_of_cases"]),
    "canopy": ("static/glass_canopy.toml", [], ["table:load_cases", "table:reactions_of_cases"]),
    "tips": ("static/glass_canopy.toml", ["--set", "geometry.cracks=[[[1.32,1.0],[1.307,0.991]],[[0.18,0.0],[0.204574561,0.017207293]]]"], ["table:load_cases", "table:reactions_of_cases"]),
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
    wrong += [what for size in PAPERS for what in page.wrong_on_paper(size)]
    canvases = [one for one in page.elements if one.name == "canvas"]
    wrong += [f"a canvas is blank: {one['data-field'] or one['class'] or 'a plot'}" for one in canvases if int(one["data-colours"] or 0) < 3]
    figures = len(page.having("data-plot")) + 2 * len(page.having("data-picture"))  # a picture has a colour bar
    if len(canvases) != figures:
        wrong.append(f"{len(canvases)} canvases for {figures}")
    return wrong


def of_first_sheets(report, summary):
    """What a check needs and the first two sheets of paper lack: what governs, and all load cases with their supports."""
    wrong = []
    for size in PAPERS:
        first, second = browser.sheets(report, size)[:2]
        tips = len({one["tip"] for one in summary["envelope"]})
        governing = max(summary["envelope"], key=lambda one: one["value"] * (one["quantity"] == "utilisation"))
        if not re.search(rf"of the toughness +tip {governing['tip']} +{governing['value']:.3f} ± \S+ +{governing['case']}(\n| )", first):
            wrong.append(f"{size}: sheet 1 does not say that {governing['case']} governs")
        rows = tips + 2  # factors of each tip, deflections and stresses, forces of the supports
        wrong += [f"{size}: sheets 1 and 2 have {found} rows of {one['name']}" for one in summary["load_cases"]
                  if (found := len(re.findall(rf"^ *{one['name']} ", first + second, re.MULTILINE))) != rows]
    return wrong


def of_screens(report, narrow):
    """What is wrong on a telephone, on a wide screen and in the dark. `narrow`: tables are so that none scrolls on a telephone."""
    wrong = []
    for width, scheme in ((390, "light"), (1600, "light"), (390, "dark"), (1600, "dark")):
        found, where = browser.measured(report, width, scheme), f"{width} px, {scheme}"
        if (found["state"], found["scheme"]) != ("drawn", scheme) or found["letters"] < 50:
            wrong.append(f"{where}: the page is {found}")
        if found["page"] > width or found["beyond"]:
            wrong.append(f"{where}: {found['page']} px wide, beyond it {found['beyond']}")
        if (narrow or width > 390) and (found["cells"] or found["zoom"] < 0.79):
            wrong.append(f"{where}: {found['cells']} cells of tables beyond the page, tables at {found['zoom']}")
        if found["contrast"] < CONTRAST:
            wrong.append(f"{where}: contrast {found['contrast']:.2f} of {found['faint']}")
        if (found["paper"] < 0.1) != (scheme == "dark"):
            wrong.append(f"{where}: the paper has the luminance {found['paper']}")
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
        found = of_page(page, wanted) + about_numbers + ([] if count > 20 else [f"only {count} numbers"])
        if name in ("canopy", "tips"):
            found += of_first_sheets(out / "report.html", summary) + of_screens(out / "report.html", narrow=True)
        if name == "units":
            found += of_screens(out / "report.html", narrow=False)
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


def run_wide_study(program, folder):
    """Thirty runs by three methods stand on two sheets of paper, with every number, though five had no room for a method."""
    out, methods = folder / "wide_study", ("virtual_crack_extension", "domain_integral", "displacement_extrapolation")
    rows = [f"{length},{formulation},{spacing},K1,tip 0,{method},{0.1927 * (1 + error):.7f},0.1926604,{error:.6f},{2 * error:.6f},{4 / spacing**2:.0f},120,{0.004 / spacing:.4f},{0.0071 / spacing:.4f},"
            for length in (0.1, 0.2, 0.3, 0.4, 0.5) for formulation in ("galerkin", "ordinary") for spacing in (0.04, 0.02, 0.01)
            for method, error in zip(methods, (0.4 * spacing * length, 0.7 * spacing, 0.9 * spacing + 0.01 * length))]
    for i, row in enumerate(rows):
        if "ordinary,0.04" in row and "domain_integral" in row:
            cells = row.split(",")
            rows[i] = ",".join([*cells[:6], "", *cells[7:8], "", "", *cells[10:-1], "the results have no K1 of tip 0 by domain_integral"])
    out.mkdir()
    (out / "study.csv").write_text("\n".join(["length,formulation,spacing,quantity,place,srif_method,computed,reference,error,estimated_error,points,iterations,seconds,processor_seconds,message", *rows, ""]))
    subprocess.run([program, "report", out], check=True)
    page = browser.Page(out / "report.html")
    wrong = of_page(page, ["table:methods", "table:study"])
    cells = [one["data-cell"] for one in page.having("data-cell")]
    wrong += [f"{len(found)} cells of {name}" for name in ("computed", "error") if len(found := {one for one in cells if one.startswith(f"{name}[")}) != 90]
    for size in PAPERS:
        if (count := len(browser.sheets(out / "report.html", size))) > 2:
            wrong.append(f"{size}: {count} sheets")
    return [f"study of 30 runs: {what}" for what in wrong]


def main(program, cases, folder):
    if not browser.chromium():
        print("chromium is not installed: the reports are not looked at")
        return 1 if os.environ.get("PDPLATE_TESTS") else MISSING
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    cases = pathlib.Path(cases).resolve()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(run_case, program, cases, folder, name) for name in CASES] + [pool.submit(run_study, program, cases, folder), pool.submit(run_wide_study, program, folder)]
        wrong = [what for job in jobs for what in job.result()]
    print("\n".join(wrong) or f"{len(jobs)} reports are as their files say")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
