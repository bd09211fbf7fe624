#include "app/shell/study/analysis_schema.hpp"

namespace lampblack::app {
namespace {

void addDecksAndParameters(DeckSchema& schema) {
  schema.add(stringKey("analysis", "Name of the analysis, for its report."))
      .add(stringKey("runs",
                     "Folder of the runs, relative to this file. Analyses that name the same folder share the runs "
                     "that they have in common; absent: runs in the folder of the analysis.")
               .optional())
      .add(integerKey("ranks_per_run", "Ranks that share a run; so many runs go on side by side as fit.")
               .byDefault("1")
               .atLeast(1))
      .section("decks", Presence::required, "The experiments: a deck each.")
      .add(stringKey("decks[].deck", "The deck, relative to this file."))
      .add(stringKey("decks[].name",
                     "How measurements call it; absent: the name of its file, or of its folder where that is "
                     "deck.yaml.")
               .optional())
      .add(stringKey("decks[].set", "Assignments to keys of this deck: [inlet.temperature=1700 K].")
               .list()
               .byDefault("[]"))
      .add(numberKey("decks[].weight", "Weight of its measurements in the objective, which are counted one by one.")
               .byDefault("1")
               .above(0)
               .onlyWith("decks[].use", {"fit", "candidate"}))
      .add(choiceKey("decks[].use", {"fit", "validate", "candidate"},
                     "fit: its measurements are fitted; validate: they are only compared with the fit; candidate: an "
                     "experiment that could be made, for `design`.")
               .byDefault("fit"))
      .add(numberKey("decks[].abscissa_from", "Smallest abscissa (SI) of the measurements of this deck that count.")
               .optional())
      .add(numberKey("decks[].abscissa_to", "Largest abscissa (SI) of the measurements of this deck that count.")
               .optional())
      .section("parameters", Presence::required, "What is varied, between bounds.")
      .add(stringKey("parameters[].name",
                     "Name of the parameter, as it stands in braces in assignments: letters, digits and _."))
      .add(numberKey("parameters[].from", "Lower bound of the parameter, in the unit that its assignments give it."))
      .add(numberKey("parameters[].to", "Upper bound of the parameter, in the same unit."))
      .add(choiceKey("parameters[].scale", {"linear", "log"}, "How designs and searches divide the range.")
               .byDefault("linear"))
      .add(numberKey("parameters[].start",
                     "The present value: of a local sensitivity and of one_at_a_time; absent: the "
                     "middle of the range on its scale.")
               .optional())
      .add(stringKey("parameters[].set",
                     "Assignments to keys of the decks, with the parameters' names in braces for their values, or for "
                     "a multiple: "
                     "['particles.surface.growth=[{A}, 1.56, 3.8]', 'particles.sticking=[{f*0.002}]'].")
               .list()
               .byDefault("[]"))
      .add(stringKey("parameters[].shift",
                     "Names of decks whose measured abscissae this parameter (in SI units) is added to before they are "
                     "looked up in the run, such as the distance of a probe from a burner.")
               .list()
               .byDefault("[]"))
      .section("parameters[].prior", Presence::optional,
               "What was known of it before; absent: nothing but the bounds, all places on its scale alike.")
      .add(choiceKey("parameters[].prior.type", {"normal", "lognormal"},
                     "normal: a mean and a standard deviation; lognormal: a median, and the standard deviation of the "
                     "natural logarithm."))
      .add(numberKey("parameters[].prior.mean", "Mean of the parameter, or its median with lognormal."))
      .add(numberKey("parameters[].prior.deviation", "Standard deviation, with lognormal of the natural logarithm.")
               .above(0));
}

void addData(DeckSchema& schema) {
  schema.section("quantities", Presence::required, "What is taken from a run, by names that measurements use.")
      .add(stringKey(
               "quantities.*.result",
               "A single number: a key of the object \"results\" of run.json, its parts joined by dots, of a list its "
               "place from 0: methods.mmc.moments.0.")
               .optional())
      .add(stringKey("quantities.*.table", "A CSV table of the run: history.csv, profile.csv.").optional())
      .add(stringKey("quantities.*.column", "Name of the column of that table, without the unit.").optional())
      .add(stringKey("quantities.*.along", "The column that holds the abscissa of measurements: time, position, z.")
               .optional())
      .add(choiceKey("quantities.*.take", {"last", "maximum", "mean"},
                     "The one number of a column where measurements have no abscissa.")
               .byDefault("last"))
      .add(stringKey("quantities.*.error",
                     "The column or result that has the standard error of a stochastic run; absent: the name with "
                     "_error, where there is one.")
               .optional())
      .add(choiceKey("quantities.*.transform", {"none", "log10"},
                     "Compared as it is, or by its decimal logarithm: numbers of particles, volume fractions.")
               .byDefault("none"))
      .add(stringKey("measurements.files",
                     "CSV files, relative to this one, with the columns deck, quantity, abscissa [unit], value [unit], "
                     "error [unit or %], source; abscissa and source may be missing.")
               .list()
               .byDefault("[]"))
      .add(numberKey("measurements.model_error",
                     "Standard deviation that the model itself is allowed, of the transformed value.")
               .byDefault("0")
               .atLeast(0));
}

void addMethods(DeckSchema& schema) {
  schema
      .add(choiceKey("design.type", {"sobol", "latin_hypercube", "factorial", "one_at_a_time", "file"},
                     "Which points: scrambled Sobol points, a Latin hypercube, all combinations of levels, one "
                     "parameter at a time from the start, or those of a CSV file.")
               .byDefault("sobol"))
      .add(integerKey("design.points", "Number of points; of Sobol points a power of two.")
               .byDefault("64")
               .atLeast(2)
               .onlyWith("design.type", {"sobol", "latin_hypercube"}))
      .add(integerKey("design.levels", "Levels of each parameter, with factorial and one_at_a_time.")
               .byDefault("3")
               .atLeast(2)
               .onlyWith("design.type", {"factorial", "one_at_a_time"}))
      .add(stringKey("design.file", "CSV file of the points, a column a parameter by its name.")
               .optional()
               .onlyWith("design.type", {"file"}))
      .add(integerKey("design.seed", "Seed of the points and of all that is drawn in the analysis.")
               .byDefault("1")
               .atLeast(0))
      .add(choiceKey("design.criterion", {"D", "A"},
                     "How experiments are chosen among the decks of use candidate: by the largest determinant of the "
                     "information "
                     "(D) or the smallest trace of the covariance (A).")
               .byDefault("D"))
      .add(integerKey("design.choose", "Number of experiments to choose among the decks of use candidate.")
               .byDefault("1")
               .atLeast(1))
      .add(integerKey("surrogate.order", "Highest degree of its polynomials.").byDefault("4").atLeast(1).atMost(12))
      .add(booleanKey("surrogate.pairs", "Whether terms of several parameters are allowed.").byDefault("true"))
      .add(numberKey("surrogate.least_r2",
                     "Smallest R2 of the points held out with which a surrogate is used; below it the analysis stops.")
               .byDefault("0.9")
               .atMost(1))
      .add(choiceKey("optimise.method", {"least_squares", "nelder_mead", "hooke_jeeves"},
                     "The local search from the best points of the design: by derivatives, or without (noisy runs).")
               .byDefault("least_squares"))
      .add(choiceKey("optimise.on", {"runs", "surrogate"}, "Whether the search asks true runs or the surrogates.")
               .byDefault("runs"))
      .add(integerKey("optimise.starts", "Number of local searches.").byDefault("3").atLeast(1))
      .add(numberKey("optimise.tolerance", "Relative change of objective and parameters at which a search ends.")
               .byDefault("1e-3")
               .above(0))
      .add(numberKey("optimise.step", "Step of differences, as a share of the range.")
               .byDefault("0.01")
               .above(0)
               .atMost(0.5))
      .add(integerKey("optimise.most_points", "Points of true runs that one search may ask for.")
               .byDefault("200")
               .atLeast(2)
               .onlyWith("optimise.on", {"runs"}))
      .add(choiceKey("uncertainty.method", {"covariance", "posterior"},
                     "Errors of the parameters: from the derivatives at the best point, or samples of the posterior on "
                     "the surrogates.")
               .byDefault("covariance"))
      .add(integerKey("uncertainty.samples", "Samples of the posterior.")
               .byDefault("20000")
               .atLeast(100)
               .onlyWith("uncertainty.method", {"posterior"}))
      .add(choiceKey("uncertainty.sampler", {"own", "emcee"},
                     "Who draws them: the stretch move of this package, or the package emcee.")
               .byDefault("own")
               .onlyWith("uncertainty.method", {"posterior"}))
      .add(choiceKey("sensitivity.method", {"surrogate", "saltelli", "morris", "local"},
                     "Sobol indices from the surrogates' coefficients or from runs alone; elementary effects; "
                     "normalised derivatives at the start.")
               .byDefault("surrogate"))
      .add(integerKey("sensitivity.points", "Number N of base points, a power of two; N (d + 2) runs for d parameters.")
               .byDefault("64")
               .atLeast(8)
               .onlyWith("sensitivity.method", {"saltelli"}))
      .add(integerKey("sensitivity.trajectories", "Number r of trajectories; r (d + 1) runs for d parameters.")
               .byDefault("10")
               .atLeast(2)
               .onlyWith("sensitivity.method", {"morris"}))
      .add(integerKey("sensitivity.levels", "Number of levels of each parameter, even.")
               .byDefault("4")
               .atLeast(2)
               .onlyWith("sensitivity.method", {"morris"}))
      .add(numberKey("sensitivity.step", "Step of the differences, as a share of the range.")
               .byDefault("0.01")
               .above(0)
               .atMost(0.5)
               .onlyWith("sensitivity.method", {"local"}))
      .add(choiceKey("propagate.from", {"prior", "posterior"},
                     "What is propagated: the prior, or the posterior that `fit` left in the same folder.")
               .byDefault("prior"))
      .add(choiceKey("propagate.through", {"surrogate", "runs"}, "The surrogates, or a true run a sample.")
               .byDefault("surrogate"))
      .add(integerKey("propagate.samples", "Number of samples.").byDefault("1000").atLeast(10))
      .section("trade_off.objectives", Presence::optional, "Two quantities that cannot both be had.")
      .add(stringKey("trade_off.objectives[].quantity", "Name of the quantity that is to be small or large."))
      .add(stringKey("trade_off.objectives[].deck", "Name of the deck whose run has it."))
      .add(choiceKey("trade_off.objectives[].sense", {"minimise", "maximise"}, "What is better.").byDefault("minimise"))
      .section("trade_off.constraints", Presence::optional, "What has to hold besides, in SI units.")
      .add(stringKey("trade_off.constraints[].quantity", "Name of a quantity."))
      .add(stringKey("trade_off.constraints[].deck", "Name of the deck whose run has it."))
      .add(numberKey("trade_off.constraints[].at_least", "Lower limit of the quantity, in SI units.").optional())
      .add(numberKey("trade_off.constraints[].at_most", "Upper limit of the quantity, in SI units.").optional())
      .add(integerKey("trade_off.points", "Points of the front.").byDefault("9").atLeast(2));
}

}  // namespace

DeckSchema analysisSchema() {
  DeckSchema schema;
  addDecksAndParameters(schema);
  addData(schema);
  addMethods(schema);
  return schema;
}

}  // namespace lampblack::app
