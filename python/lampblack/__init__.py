"""Reading results of Lampblack, and pictures of them (`lampblack.plots`)."""
