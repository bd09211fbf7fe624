"""Pictures of runs and studies; `python3 -m lampblack.plots --help`."""
