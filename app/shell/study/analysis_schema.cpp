#include "app/shell/study/analysis_schema.hpp"

#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

void addDecksAndParameters(DeckSchema& schema) {
  SectionKeys keys("");
  keys.text("analysis", rules(), "Name of the analysis, for its report.");
  keys.text("runs", rules().optional(),
            "Folder of the runs, relative to this file. Analyses that name the same folder share the runs that they "
            "have in common; absent: runs in the folder of the analysis.");
  keys.integer("ranks_per_run", rules().byDefault("1").atLeast(1),
               "Ranks that share a run; so many runs go on side by side as fit.");
  keys.section("decks", Presence::required, "The experiments: a deck each.");
  keys.text("decks[].deck", rules(), "The deck, relative to this file.");
  keys.text("decks[].name", rules().optional(),
            "How measurements call it; absent: the name of its file, or of its folder where that is deck.yaml.");
  keys.text("decks[].set", rules().list().byDefault("[]"),
            "Assignments to keys of this deck: [inlet.temperature=1700 K].");
  keys.number("decks[].weight", rules().byDefault("1").above(0).onlyWith("decks[].use", {"fit", "candidate"}),
              "Weight of its measurements in the objective, which are counted one by one.");
  keys.choice("decks[].use", {"fit", "validate", "candidate"}, rules().byDefault("fit"),
              "fit: its measurements are fitted; validate: they are only compared with the fit; candidate: an "
              "experiment that could be made, for `design`.");
  keys.number("decks[].abscissa_from", rules().optional(),
              "Smallest abscissa (SI) of the measurements of this deck that count.");
  keys.number("decks[].abscissa_to", rules().optional(),
              "Largest abscissa (SI) of the measurements of this deck that count.");
  keys.section("parameters", Presence::required, "What is varied, between bounds.");
  keys.text("parameters[].name", rules(),
            "Name of the parameter, as it stands in braces in assignments: letters, digits and _.");
  keys.number("parameters[].from", rules(), "Lower bound of the parameter, in the unit that its assignments give it.");
  keys.number("parameters[].to", rules(), "Upper bound of the parameter, in the same unit.");
  keys.choice("parameters[].scale", {"linear", "log"}, rules().byDefault("linear"),
              "How designs and searches divide the range.");
  keys.number(
      "parameters[].start", rules().optional(),
      "The present value: of a local sensitivity and of one_at_a_time; absent: the middle of the range on its scale.");
  keys.text("parameters[].set", rules().list().byDefault("[]"),
            "Assignments to keys of the decks, with the parameters' names in braces for their values, or for a "
            "multiple: ['particles.surface.growth=[{A}, 1.56, 3.8]', 'particles.sticking=[{f*0.002}]'].");
  keys.text("parameters[].shift", rules().list().byDefault("[]"),
            "Names of decks whose measured abscissae this parameter (in SI units) is added to before they are looked "
            "up in the run, such as the distance of a probe from a burner.");
  keys.section("parameters[].prior", Presence::optional,
               "What was known of it before; absent: nothing but the bounds, all places on its scale alike.");
  keys.choice("parameters[].prior.type", {"normal", "lognormal"}, rules(),
              "normal: a mean and a standard deviation; lognormal: a median, and the standard deviation of the natural "
              "logarithm.");
  keys.number("parameters[].prior.mean", rules(), "Mean of the parameter, or its median with lognormal.");
  keys.number("parameters[].prior.deviation", rules().above(0),
              "Standard deviation, with lognormal of the natural logarithm.");
  schema.add(keys.schema());
}

void addData(DeckSchema& schema) {
  SectionKeys keys("");
  keys.section("quantities", Presence::required, "What is taken from a run, by names that measurements use.");
  keys.text("quantities.*.result", rules().optional(),
            "A single number: a key of the object \"results\" of run.json, its parts joined by dots, of a list its "
            "place from 0: methods.mmc.moments.0.");
  keys.text("quantities.*.table", rules().optional(), "A CSV table of the run: history.csv, profile.csv.");
  keys.text("quantities.*.column", rules().optional(), "Name of the column of that table, without the unit.");
  keys.text("quantities.*.along", rules().optional(),
            "The column that holds the abscissa of measurements: time, position, z.");
  keys.choice("quantities.*.take", {"last", "maximum", "mean"}, rules().byDefault("last"),
              "The one number of a column where measurements have no abscissa.");
  keys.text("quantities.*.error", rules().optional(),
            "The column or result that has the standard error of a stochastic run; absent: the name with _error, where "
            "there is one.");
  keys.choice("quantities.*.transform", {"none", "log10"}, rules().byDefault("none"),
              "Compared as it is, or by its decimal logarithm: numbers of particles, volume fractions.");
  keys.text("measurements.files", rules().list().byDefault("[]"),
            "CSV files, relative to this one, with the columns deck, quantity, abscissa [unit], value [unit], error "
            "[unit or %], source; abscissa and source may be missing.");
  keys.number("measurements.model_error", rules().byDefault("0").atLeast(0),
              "Standard deviation that the model itself is allowed, of the transformed value.");
  schema.add(keys.schema());
}

void addMethods(DeckSchema& schema) {
  SectionKeys keys("");
  keys.choice("design.type", {"sobol", "latin_hypercube", "factorial", "one_at_a_time", "file"},
              rules().byDefault("sobol"),
              "Which points: scrambled Sobol points, a Latin hypercube, all combinations of levels, one parameter at a "
              "time from the start, or those of a CSV file.");
  keys.integer("design.points",
               rules().byDefault("64").atLeast(2).onlyWith("design.type", {"sobol", "latin_hypercube"}),
               "Number of points; of Sobol points a power of two.");
  keys.integer("design.levels",
               rules().byDefault("3").atLeast(2).onlyWith("design.type", {"factorial", "one_at_a_time"}),
               "Levels of each parameter, with factorial and one_at_a_time.");
  keys.text("design.file", rules().optional().onlyWith("design.type", {"file"}),
            "CSV file of the points, a column a parameter by its name.");
  keys.integer("design.seed", rules().byDefault("1").atLeast(0),
               "Seed of the points and of all that is drawn in the analysis.");
  keys.choice("design.criterion", {"D", "A"}, rules().byDefault("D"),
              "How experiments are chosen among the decks of use candidate: by the largest determinant of the "
              "information (D) or the smallest trace of the covariance (A).");
  keys.integer("design.choose", rules().byDefault("1").atLeast(1),
               "Number of experiments to choose among the decks of use candidate.");
  keys.integer("surrogate.order", rules().byDefault("4").atLeast(1).atMost(12), "Highest degree of its polynomials.");
  keys.boolean("surrogate.pairs", rules().byDefault("true"), "Whether terms of several parameters are allowed.");
  keys.number("surrogate.least_r2", rules().byDefault("0.9").atMost(1),
              "Smallest R2 of the points held out with which a surrogate is used; below it the analysis stops.");
  keys.choice("optimise.method", {"least_squares", "nelder_mead", "hooke_jeeves"}, rules().byDefault("least_squares"),
              "The local search from the best points of the design: by derivatives, or without (noisy runs).");
  keys.choice("optimise.on", {"runs", "surrogate"}, rules().byDefault("runs"),
              "Whether the search asks true runs or the surrogates.");
  keys.integer("optimise.starts", rules().byDefault("3").atLeast(1), "Number of local searches.");
  keys.number("optimise.tolerance", rules().byDefault("1e-3").above(0),
              "Relative change of objective and parameters at which a search ends.");
  keys.number("optimise.step", rules().byDefault("0.01").above(0).atMost(0.5),
              "Step of differences, as a share of the range.");
  keys.integer("optimise.most_points", rules().byDefault("200").atLeast(2).onlyWith("optimise.on", {"runs"}),
               "Points of true runs that one search may ask for.");
  keys.choice("uncertainty.method", {"covariance", "posterior"}, rules().byDefault("covariance"),
              "Errors of the parameters: from the derivatives at the best point, or samples of the posterior on the "
              "surrogates.");
  keys.integer("uncertainty.samples",
               rules().byDefault("20000").atLeast(100).onlyWith("uncertainty.method", {"posterior"}),
               "Samples of the posterior.");
  keys.choice("uncertainty.sampler", {"own", "emcee"},
              rules().byDefault("own").onlyWith("uncertainty.method", {"posterior"}),
              "Who draws them: the stretch move of this package, or the package emcee.");
  keys.choice("sensitivity.method", {"surrogate", "saltelli", "morris", "local"}, rules().byDefault("surrogate"),
              "Sobol indices from the surrogates' coefficients or from runs alone; elementary effects; normalised "
              "derivatives at the start.");
  keys.integer("sensitivity.points", rules().byDefault("64").atLeast(8).onlyWith("sensitivity.method", {"saltelli"}),
               "Number N of base points, a power of two; N (d + 2) runs for d parameters.");
  keys.integer("sensitivity.trajectories",
               rules().byDefault("10").atLeast(2).onlyWith("sensitivity.method", {"morris"}),
               "Number r of trajectories; r (d + 1) runs for d parameters.");
  keys.integer("sensitivity.levels", rules().byDefault("4").atLeast(2).onlyWith("sensitivity.method", {"morris"}),
               "Number of levels of each parameter, even.");
  keys.number("sensitivity.step",
              rules().byDefault("0.01").above(0).atMost(0.5).onlyWith("sensitivity.method", {"local"}),
              "Step of the differences, as a share of the range.");
  keys.choice("propagate.from", {"prior", "posterior"}, rules().byDefault("prior"),
              "What is propagated: the prior, or the posterior that `fit` left in the same folder.");
  keys.choice("propagate.through", {"surrogate", "runs"}, rules().byDefault("surrogate"),
              "The surrogates, or a true run a sample.");
  keys.integer("propagate.samples", rules().byDefault("1000").atLeast(10), "Number of samples.");
  keys.section("trade_off.objectives", Presence::optional, "Two quantities that cannot both be had.");
  keys.text("trade_off.objectives[].quantity", rules(), "Name of the quantity that is to be small or large.");
  keys.text("trade_off.objectives[].deck", rules(), "Name of the deck whose run has it.");
  keys.choice("trade_off.objectives[].sense", {"minimise", "maximise"}, rules().byDefault("minimise"),
              "What is better.");
  keys.section("trade_off.constraints", Presence::optional, "What has to hold besides, in SI units.");
  keys.text("trade_off.constraints[].quantity", rules(), "Name of a quantity.");
  keys.text("trade_off.constraints[].deck", rules(), "Name of the deck whose run has it.");
  keys.number("trade_off.constraints[].at_least", rules().optional(), "Lower limit of the quantity, in SI units.");
  keys.number("trade_off.constraints[].at_most", rules().optional(), "Upper limit of the quantity, in SI units.");
  keys.integer("trade_off.points", rules().byDefault("9").atLeast(2), "Points of the front.");
  schema.add(keys.schema());
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
