"""From runs to answers: parameters of decks fitted to measurements, which of them matter, and what is unknown of results.

`lampblack fit | sensitivity | propagate | design | trade_off ANALYSIS` reads an analysis by its schema (docs/deck.md) and hands it to this
package, which starts the runs by `lampblack sweep`. Methods work on the unit cube: each parameter goes from 0 to 1 on its scale.
Needs numpy, h5py and scipy; emcee only where an analysis asks for it.
"""
