"""Makes pictures of a run or study: planes of the last step, profiles along the centreline, particle sizes (of ensembles in
cells also a film), history; of a reactor its history, ignition and sensitivities, and where it has tables of every particle
micrographs, distributions and averages by size; of particles along a given gas their history, rates and sizes; of a population
balance moments, errors and
size distributions; of molecules their growth, mass spectrum and rings; of aggregates of spheres their shape and micrographs; of an engine its cycle, emissions, soot and particles; of a one-dimensional flame its profiles, soot and sensitivities; of a study its
runs compared, and errors against numbers of particles; of several one-dimensional flames one picture that compares them; of an analysis measurements and
runs, indices, pairs of parameters, the objective, bands, fronts.

Usage: lampblack plot RESULTS_DIR [RESULTS_DIR...] [--reference CSV]... [--fields FIELD...]
"""

import argparse
import pathlib
import sys


def main():
    parser = argparse.ArgumentParser(prog="lampblack plot", description=" ".join(__doc__.split("Usage:")[0].split()))
    parser.add_argument("results", type=pathlib.Path, nargs="+", help="folder of a run; several flames are compared")
    parser.add_argument("--reference", type=pathlib.Path, action="append", default=[],
                        help="profile to draw over the centreline (columns z_m, T_K, X_...); "
                             "otherwise those in reference/ beside the deck")
    parser.add_argument("--fields", nargs="+", default=[], metavar="FIELD",
                        help="of a flow or a flame, only these: a picture each, of fields by their names in the results (X_OH, "
                             "heat_release) and mass fractions (Y_OH)")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the pictures; RESULTS_DIR/pictures otherwise")
    arguments = parser.parse_args()
    folders, arguments.results = arguments.results, arguments.results[0]

    try:
        from ..analysis.folder import is_analysis
        from .along import plot_along
        from .analyses import plot_analysis
        from .engine import plot_engine
        from .ensembles import plot_ensembles
        from .fields import plot_fields
        from .flame import plot_flame, plot_together
        from .flame_course import plot_branch, plot_course
        from .flame_study import is_flame_study, plot_flame_study
        from .history import plot_history
        from .molecules import plot_molecules
        from .planes import plot_planes
        from .population import plot_population
        from .profiles import plot_profiles
        from .reactor import plot_reactor
        from .sensitivities import plot_sensitivities
        from ..reference import ProfileError, find_references, read_reference
        from ..results import Results, ResultsError
        from .sizes import plot_sizes
        from .spheres_in_space import plot_spheres
        from ..study import is_study
        from .study import plot_study
        from .style import Pictures
        from .walls import plot_walls
    except ImportError as error:
        print(f"{error}. Pictures need numpy, h5py and matplotlib (Debian: python3-h5py python3-matplotlib).", file=sys.stderr)
        return 1

    pictures = Pictures(arguments.out or arguments.results / "pictures")
    try:
        if len(folders) > 1:
            if not all(Results(folder).is_flame for folder in folders):
                raise ResultsError("only one-dimensional flames can be compared in one picture")
            plot_together(folders, pictures)
            return finish(arguments, pictures)
        if is_analysis(arguments.results):
            plot_analysis(arguments.results, pictures)
            return finish(arguments, pictures)
        if is_study(arguments.results):
            (plot_flame_study if is_flame_study(arguments.results) else plot_study)(arguments.results, pictures)
            return finish(arguments, pictures)
        results = Results(arguments.results)
        if arguments.fields:
            plot_fields(results, arguments.fields, pictures)
            return finish(arguments, pictures)
        without_references = not results.is_flow
        references = [] if without_references else arguments.reference or find_references(results)
        for path in references:
            read_reference(path)
    except (ResultsError, ProfileError) as error:
        print(error, file=sys.stderr)
        return 2

    if results.partial:
        print("These are the results of a run that has not finished.")
    if results.is_reactor:
        plot_reactor(results, pictures)
    elif results.is_along:
        plot_along(results, pictures)
    elif results.is_population:
        plot_population(results, pictures)
    elif results.is_pah:
        plot_molecules(results, pictures)
    elif results.is_aggregates:
        plot_spheres(results, pictures)
    elif results.is_engine:
        plot_engine(results, pictures)
    elif results.is_flame:
        plot_flame(results, pictures)
        plot_branch(results, pictures)
        plot_course(results, pictures)
        plot_sensitivities(results, pictures)
    else:
        plot_planes(results, pictures)
        plot_profiles(results, pictures, references)
        plot_sizes(results, pictures)
        plot_ensembles(results, pictures)
        plot_walls(results, pictures)
        plot_history(results, pictures)
    return finish(arguments, pictures)


def finish(arguments, pictures):
    """Says what was made and what was not."""
    for line in pictures.skipped:
        print(f"not drawn - {line}")
    for path in pictures.made:
        print(path)
    if not pictures.made:
        print(f"{arguments.results}: there was nothing to draw", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    from ..damage import guarded

    sys.exit(guarded(main))
