// SortedStore: chunks that fill, split, run empty and are joined. Included by sorted_store.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"

namespace lampblack::particles {

template <SortedRates Rates>
SortedStore<Rates>::SortedStore(Rates rates) : rates_(std::move(rates)), rank_(rates_.rank()), sums_(0) {
  quantities_ = 4 * rank_;
  for (std::size_t process = 0; process < singleProcesses; ++process) {
    singleQuantity_[process] = rates_.active(static_cast<SingleProcess>(process)) ? quantities_++ : unused;
  }
  sums_ = SumsOfChunks(quantities_);
  clear();
}

template <SortedRates Rates>
std::size_t SortedStore<Rates>::bytes() const {
  std::size_t sum = chunks_.capacity() * sizeof(Chunk) + free_.capacity() * sizeof(Slot) + directory_.bytes() +
                    sums_.bytes() + least_.bytes() + heaviest_.bytes();
  for (const Chunk& chunk : chunks_) sum += chunk.particles.capacity() * sizeof(decltype(Entry::particle));
  return sum;
}

template <SortedRates Rates>
void SortedStore<Rates>::clear() {
  chunks_.clear();
  free_.clear();
  size_ = 0;
  sums_.reset(1);
  least_.reset(1);
  heaviest_.reset(1);
  first_ = makeChunk();
  recent_ = {first_, first_};
  expected_.fill(first_);
  ahead_ = {};
  directory_.reset(first_);
  findLeast(chunks_[first_]);
  publish(first_);
}

template <SortedRates Rates>
void SortedStore<Rates>::assign(std::vector<Entry> entries) {
  const auto less = [this](const Entry& a, const Entry& b) {
    const double va = rates_.volume(a), vb = rates_.volume(b);
    return va < vb || (va == vb && rates_.weight(a) < rates_.weight(b));
  };
  if (!std::is_sorted(entries.begin(), entries.end(), less)) std::sort(entries.begin(), entries.end(), less);
  clear();
  const std::size_t count = std::max<std::size_t>((entries.size() + filled - 1) / filled, 1);
  if (count > chunks_.capacity()) chunks_.reserve(count + count / 4);
  sums_.reserve(count);
  least_.reserve(count);
  Slot slot = first_;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const double volume = rates_.volume(entries[k]), weight = rates_.weight(entries[k]);
    if (k % filled == 0 && k > 0) {
      const Slot fresh = makeChunk();
      link(slot, fresh);
      directory_.insertAfter(slot, fresh, volume, weight);
      chunks_[slot].setNextVolume(volume);
      slot = fresh;
    }
    Chunk& chunk = chunks_[slot];
    if constexpr (!Rates::bare) chunk.particles.push_back(std::move(entries[k].particle));
    chunk.insertAt(chunk.size, volume, weight);
  }
  size_ = entries.size();
  for (slot = first_; slot != none; slot = chunks_[slot].next) {
    Chunk& chunk = chunks_[slot];
    findLeast(chunk);
    setLeast(slot);
    findBounds(chunk);
    publish(slot);
    chunk.heaviest = chunk.largestWeight();
    chunk.heaviestExact = true;
    if (rates_.keepsHeaviest()) setHeaviest(slot);
  }
}

template <SortedRates Rates>
void SortedStore<Rates>::insert(const Entry& entry, std::size_t copies) {
  for (; copies > Chunk::mostCopies; copies -= Chunk::mostCopies) insert(entry, Chunk::mostCopies);
  if (copies == 0) return;
  const auto count = static_cast<std::uint32_t>(copies);
  const double volume = rates_.volume(entry), weight = rates_.weight(entry);
  Slot slot = locate(volume, weight);
  if (chunks_[slot].size + count > Chunk::capacity) {
    split(slot);
    const Slot upper = chunks_[slot].next;
    if (chunks_[upper].below(0, volume, weight)) slot = upper;
  }
  Chunk& chunk = chunks_[slot];
  const std::uint32_t at = chunk.position(volume, weight);
  if constexpr (!Rates::bare) chunk.particles.insert(chunk.particles.begin() + at, copies, entry.particle);
  chunk.insertAt(at, volume, weight, count);
  size_ += copies;
  chunk.leastMovedUp(at, count);
  consider(chunk, at);
  if (count > 1) consider(chunk, at + count - 1);
  if (at > 0) {
    consider(chunk, at - 1);
  } else if (chunk.previous != none) {
    Chunk& previous = chunks_[chunk.previous];
    previous.setNextVolume(volume);
    consider(previous, previous.size - 1);
    setLeast(chunk.previous);
  }
  setLeast(slot);
  if (rates_.keepsHeaviest() && weight >= chunk.heaviest) {
    chunk.heaviest = weight;
    chunk.heaviestExact = true;
    setHeaviest(slot);
  }
  if (raiseBounds(chunk, entry))
    publish(slot);
  else
    touched(slot);
}

template <SortedRates Rates>
inline bool SortedStore<Rates>::lessen(Place place, double weight) {
  Chunk& chunk = chunks_[place.slot];
  const double before = chunk.weight(place.at), volume = chunk.volume(place.at);
  if (weight == before) return true;
  // The entry may come to be before entries of the same volume, but as the first one might be below the chunk's
  // boundary.
  if (place.at == 0 || !chunk.below(0, volume, weight)) return false;
  std::uint32_t to = place.at;
  while (!chunk.below(to - 1, volume, weight)) --to;
  chunk.lessenWeight(place.at, to, weight);
  if constexpr (!Rates::bare) {
    const auto particles = chunk.particles.begin();
    std::rotate(particles + to, particles + place.at, particles + place.at + 1);
  }
  if (before == chunk.heaviest) chunk.heaviestExact = false;
  consider(chunk, to);  // the others that have moved are of the same volume and heavier
  setLeast(place.slot);
  return true;
}

template <SortedRates Rates>
void SortedStore<Rates>::erase(Place place) {
  Chunk& chunk = chunks_[place.slot];
  if (chunk.weight(place.at) == chunk.heaviest) chunk.heaviestExact = false;
  chunk.eraseAt(place.at);
  --size_;
  chunk.leastMovedDown(place.at);
  if (place.at == 0 && chunk.previous != none) {
    Chunk& previous = chunks_[chunk.previous];
    previous.setNextVolume(chunk.volume(0));
    if (previous.leastAt + 1 == previous.size) previous.stale = true;
  }
}

template <SortedRates Rates>
void SortedStore<Rates>::eraseTwo(Place place) {
  Chunk& chunk = chunks_[place.slot];
  chunk.heaviestExact = false;
  chunk.eraseTwo(place.at);
  size_ -= 2;
  chunk.stale = true;
  if (place.at == 0 && chunk.previous != none) {
    Chunk& previous = chunks_[chunk.previous];
    previous.setNextVolume(chunk.volume(0));
    if (previous.leastAt + 1 == previous.size) previous.stale = true;
  }
}

template <SortedRates Rates>
void SortedStore<Rates>::joinIfSparse(Slot slot) {
  if (chunks_[slot].size >= sparse || !join(slot)) touched(slot);
}

template <SortedRates Rates>
typename Rates::Entry SortedStore<Rates>::take(Place place) {
  Entry entry = entryAt(chunks_[place.slot], place.at);
  erase(place);
  recent_ = {place.slot, recent_[0]};
  joinIfSparse(place.slot);
  return entry;
}

template <SortedRates Rates>
typename SortedStore<Rates>::Slot SortedStore<Rates>::makeChunk() {
  Slot slot;
  if (free_.empty()) {
    slot = static_cast<Slot>(chunks_.size());
    if (slot == chunks_.capacity()) chunks_.reserve(slot + slot / 4 + 8);  // less to spare than when doubled
    chunks_.emplace_back();
    sums_.reserve(chunks_.size());
    least_.reserve(chunks_.size());
    if (rates_.keepsHeaviest()) heaviest_.reserve(chunks_.size());
  } else {
    slot = free_.back();
    free_.pop_back();
    chunks_[slot] = Chunk();
  }
  chunks_[slot].used = true;
  if constexpr (!Rates::bare) chunks_[slot].particles.reserve(Chunk::capacity);
  return slot;
}

template <SortedRates Rates>
void SortedStore<Rates>::link(Slot after, Slot fresh) {
  chunks_[fresh].previous = after;
  chunks_[fresh].next = chunks_[after].next;
  chunks_[after].next = fresh;
  if (chunks_[fresh].next != none) chunks_[chunks_[fresh].next].previous = fresh;
}

// The upper half of a full chunk becomes one of its own.
template <SortedRates Rates>
void SortedStore<Rates>::split(Slot slot) {
  const Slot fresh = makeChunk();
  link(slot, fresh);
  Chunk &lower = chunks_[slot], &upper = chunks_[fresh];
  const std::uint32_t half = lower.size / 2;
  upper.moveFrom(lower, half);
  lower.setNextVolume(upper.volume(0));
  directory_.insertAfter(slot, fresh, upper.volume(0), upper.weight(0));
  for (const Slot s : {slot, fresh}) {
    Chunk& chunk = chunks_[s];
    findLeast(chunk);
    setLeast(s);
    chunk.heaviest = chunk.largestWeight();
    chunk.heaviestExact = true;
    if (rates_.keepsHeaviest()) setHeaviest(s);
    findBounds(chunk);
    publish(s);
  }
}

// With a neighbour, if both fit; whether they did.
template <SortedRates Rates>
bool SortedStore<Rates>::join(Slot slot) {
  const Chunk& chunk = chunks_[slot];
  const auto fits = [&](Slot other) {
    return other != none && (chunk.size == 0 || chunk.size + chunks_[other].size <= filled);
  };
  if (fits(chunk.next))
    absorbNext(slot);
  else if (fits(chunk.previous))
    absorbNext(chunk.previous);
  else
    return false;
  return true;
}

template <SortedRates Rates>
void SortedStore<Rates>::absorbNext(Slot slot) {
  Chunk& chunk = chunks_[slot];
  const Slot gone = chunk.next;
  Chunk& next = chunks_[gone];
  chunk.moveFrom(next, 0);
  chunk.next = next.next;
  if (chunk.next != none) chunks_[chunk.next].previous = slot;
  directory_.erase(gone);
  next = Chunk();
  free_.push_back(gone);
  forget(gone);
  findLeast(chunk);
  setLeast(slot);
  chunk.heaviest = chunk.largestWeight();
  chunk.heaviestExact = true;
  if (rates_.keepsHeaviest()) setHeaviest(slot);
  findBounds(chunk);
  publish(slot);
}

template <SortedRates Rates>
template <class F>
void SortedStore<Rates>::forEach(F&& f) const {
  for (Slot slot = first_; slot != none; slot = chunks_[slot].next) {
    const Chunk& chunk = chunks_[slot];
    for (std::uint32_t k = 0; k < chunk.size; ++k) {
      const Entry entry = entryAt(chunk, k);
      f(entry);
    }
  }
}

template <SortedRates Rates>
template <class F>
void SortedStore<Rates>::transform(F&& f) {
  std::vector<Entry> entries;
  entries.reserve(size_);
  forEach([&](Entry entry) {
    if (f(entry)) entries.push_back(std::move(entry));
  });
  assign(std::move(entries));
}

template <SortedRates Rates>
template <class F>
void SortedStore<Rates>::changeRates(F&& change) {
  change(rates_);
  for (Slot slot = first_; slot != none; slot = chunks_[slot].next) {
    findBounds(chunks_[slot]);
    publish(slot);
  }
}

}  // namespace lampblack::particles
