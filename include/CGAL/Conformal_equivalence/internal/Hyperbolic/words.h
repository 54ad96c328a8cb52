// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Words in generators of a group: the letter k > 0 is the generator k - 1, and -k its inverse.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_WORDS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_WORDS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef std::vector<std::int32_t> Word;

inline Word inverse(const Word& w)
{
  Word result(w.rbegin(), w.rend());
  for(std::int32_t& letter : result)
    letter = -letter;
  return result;
}

// The product, freely reduced, if both words are.
inline Word reduced_product(Word x, const Word& y)
{
  std::size_t n = 0; // letters of y that cancel
  while(n < y.size() && !x.empty() && x.back() == -y[n])
  {
    x.pop_back();
    ++n;
  }
  x.insert(x.end(), y.begin() + std::ptrdiff_t(n), y.end());
  return x;
}

template <typename... Words>
Word product(const Word& x, const Words&... others)
{
  Word result = x;
  ((result = reduced_product(std::move(result), others)), ...);
  return result;
}

// What words stand for in a group. Words that were asked for are remembered.
template <typename Element>
class Word_values
{
public:
  // `generators` and their inverses; `identity`
  Word_values(std::vector<Element> generators, const Element& identity) : generators_(std::move(generators)), identity_(identity)
  {
    for(const Element& g : generators_)
      inverses_.push_back(g.inverse());
  }

  const Element& operator()(const Word& w)
  {
    const auto found = values_.find(w);
    if(found != values_.end())
      return found->second;
    return values_.emplace(w, compute(w)).first->second;
  }

private:
  Element compute(const Word& w) const
  {
    Element result = identity_;
    for(const std::int32_t letter : w)
      result = result * (letter > 0 ? generators_[std::size_t(letter - 1)] : inverses_[std::size_t(-letter - 1)]);
    return result;
  }

  std::vector<Element> generators_, inverses_;
  const Element identity_;
  std::map<Word, Element> values_;
};

// The change from the generators of a one-relator presentation of the group of a closed surface, in which every letter occurs twice, with both signs, to
// canonical ones a_1, b_1, ..., a_g, b_g, whose product of commutators [a_i, b_i] = a_i b_i a_i^-1 b_i^-1 is the relation (the normal form of closed surfaces,
// by cutting and pasting; H. R. Brahana, 1921). An interleaved pair of letters is split off in turn:
//
//   S x P y Q x^-1 R y^-1 Z  =  [a, b] (S R Q P Z)   with  T = R Q,  a = S x (S T)^-1,  b = S T P y Q (S T)^-1.
//
// So a and b are words in the generators given, and x = S^-1 a S T, y = P^-1 (S T)^-1 b S T Q^-1 have in them, but for a and b, generators that
// are split off later.
struct Canonical_generators
{
  struct Pair
  {
    std::int32_t x, y; // letters
    Word s, p, q, r;
  };
  std::vector<Pair> pairs; // in the order of their commutators
  bool is_complete = true; // else the relation is that of no closed orientable surface

  explicit Canonical_generators(Word relation)
  {
    while(!relation.empty())
      if(!split_off(relation))
      {
        is_complete = false;
        return;
      }
  }

  // a_1, b_1, ... as words in the generators given.
  std::vector<Word> words() const
  {
    std::vector<Word> result;
    for(const Pair& pair : pairs)
    {
      const Word st = product(pair.s, pair.r, pair.q), back = inverse(st);
      result.push_back(product(pair.s, Word{pair.x}, back));
      result.push_back(product(st, pair.p, Word{pair.y}, pair.q, back));
    }
    return result;
  }

  // The generators given, for elements of a group in the place of a_1, b_1, ...
  template <typename Element>
  std::vector<Element> given(const std::vector<Element>& canonical, const Element& identity) const
  {
    std::vector<Element> result(canonical.size(), identity), inverses(canonical.size(), identity);
    const auto value = [&](const Word& w)
    {
      Element product = identity;
      for(const std::int32_t letter : w)
        product = product * (letter > 0 ? result[std::size_t(letter - 1)] : inverses[std::size_t(-letter - 1)]);
      return product;
    };
    const auto set = [&](std::int32_t letter, const Element& x)
    {
      const std::size_t n = std::size_t(letter > 0 ? letter : -letter) - 1;
      result[n] = letter > 0 ? x : x.inverse();
      inverses[n] = letter > 0 ? x.inverse() : x;
    };
    for(std::size_t n = pairs.size(); n > 0; --n)
    {
      const Pair& pair = pairs[n - 1];
      const Element s = value(pair.s), st = value(product(pair.s, pair.r, pair.q));
      set(pair.x, s.inverse() * canonical[2 * n - 2] * st);
      set(pair.y, value(inverse(pair.p)) * st.inverse() * canonical[2 * n - 1] * st * value(inverse(pair.q)));
    }
    return result;
  }

private:
  // The interleaved pair that spans the fewest letters.
  bool split_off(Word& w)
  {
    const std::size_t n = w.size();
    std::map<std::int32_t, std::size_t> place;
    for(std::size_t i = 0; i < n; ++i)
      place[w[i]] = i;
    std::size_t first = n, span = n + 1;
    std::pair<std::size_t, std::size_t> inner(0, 0); // places of y and x^-1
    for(std::size_t i = 0; i < n; ++i)
    {
      const auto end = place.find(-w[i]);
      if(end == place.end())
        return false;
      const std::size_t j = end->second;
      for(std::size_t k = i + 1; k < j; ++k)
      {
        const auto partner = place.find(-w[k]);
        if(partner == place.end() || partner->second <= j || partner->second - i >= span)
          continue;
        first = i;
        span = partner->second - i;
        inner = std::make_pair(k, j);
      }
    }
    if(first == n)
      return false;
    const auto at = [&](std::size_t i) { return w.begin() + std::ptrdiff_t(i); };
    const std::size_t last = first + span;
    Pair pair;
    pair.x = w[first];
    pair.y = w[inner.first];
    pair.s.assign(w.begin(), at(first));
    pair.p.assign(at(first + 1), at(inner.first));
    pair.q.assign(at(inner.first + 1), at(inner.second));
    pair.r.assign(at(inner.second + 1), at(last));
    const Word z(at(last + 1), w.end());
    w = product(pair.s, pair.r, pair.q, pair.p, z);
    pairs.push_back(std::move(pair));
    return true;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_WORDS_H
