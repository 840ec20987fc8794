#!/usr/bin/python3
"""K1 of a central crack against its length: one run for each, nothing written but the plot.

    cases/python/crack_lengths.py [--lengths 0.1 0.2 ...] [--spacing 0.02] [--plot crack_lengths.svg]

A square plate of side 2, simply supported below and above, under pressure (cases/static/central_crack_pressure.toml). Prints a table;
the plot, with the estimated errors as bars, needs python3-matplotlib."""
import argparse

import pdplate


def plate(length, spacing):
    """The case of one length."""
    return {
        "section": {"young": 1000.0, "poisson": 0.3, "thickness": 0.1},
        "geometry": {"outline": {"rectangle": [-1, -1, 1, 1]}, "cracks": [[[-length / 2, 0], [length / 2, 0]]]},
        "discretization": {"spacing": spacing},
        "support": [{"edges": ["bottom", "top"], "kind": "simply_supported"}],
        "load": [{"kind": "pressure", "value": 1.0}],
        "analysis": {"kind": "static"},
        "srif": {"normalize": {"pressure": 1.0, "width": 2.0}, "half_length": length / 2},
    }


def sweep(lengths, spacing):
    """Of each length: K1, its estimated error and F1, by the recommended method."""
    rows = []
    for length in lengths:
        best = pdplate.run(plate(length, spacing), fields=False).factors[0]
        rows.append((length, best["K1"], best["estimated_error_K1"], best["F1"]))
    return rows


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")  # a file, no window
    from matplotlib import pyplot

    lengths, factors, errors, _ = zip(*rows)
    figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
    axes.errorbar(lengths, factors, yerr=errors, marker="o", capsize=3)
    axes.set(xlabel="length of the crack", ylabel="$K_1$", title="Central crack in a square plate under pressure", xlim=(0, None),
             ylim=(0, None))
    axes.grid(alpha=0.3)
    figure.savefig(path)
    pyplot.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lengths", type=float, nargs="+", default=[0.2, 0.4, 0.6, 0.8, 1.0, 1.2])
    parser.add_argument("--spacing", type=float, default=0.02)
    parser.add_argument("--plot", metavar="FILE", help="file of the plot: .svg, .png or .pdf")
    arguments = parser.parse_args()
    rows = sweep(arguments.lengths, arguments.spacing)
    print("length         K1   error      F1")
    for length, factor, error, shape in rows:
        print(f"{length:6.3g} {factor:10.6g} {error / factor:6.2%} {shape:7.4f}")
    if arguments.plot:
        draw(rows, arguments.plot)


if __name__ == "__main__":
    main()
