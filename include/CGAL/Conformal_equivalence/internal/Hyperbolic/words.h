// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Words in generators of a group: the letter k > 0 is the generator k - 1, and -k its inverse.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_WORDS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_WORDS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
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

// Generators of a group and their inverses, by letter.
template <typename Element>
class Letter_values
{
public:
  Letter_values(std::size_t number_of_generators, const Element& identity)
    : identity_(identity), generator_(number_of_generators, identity), inverse_(number_of_generators, identity)
  {}

  void set(std::int32_t letter, const Element& x)
  {
    const std::size_t n = std::size_t(letter > 0 ? letter : -letter) - 1;
    generator_[n] = letter > 0 ? x : x.inverse();
    inverse_[n] = letter > 0 ? x.inverse() : x;
  }

  const Element& operator[](std::int32_t letter) const
  {
    return letter > 0 ? generator_[std::size_t(letter - 1)] : inverse_[std::size_t(-letter - 1)];
  }

  Element operator()(const Word& w) const { return product_of_letters(w, *this); }

  const Element& identity() const { return identity_; }

  const std::vector<Element>& generators() const { return generator_; }

private:
  const Element identity_;
  std::vector<Element> generator_, inverse_;
};

template <typename Element>
Element product_of_letters(const Word& w, const Letter_values<Element>& values)
{
  Element result = values.identity();
  for(const std::int32_t letter : w)
    result = result * values[letter];
  return result;
}

// What words stand for in a group. Words that were asked for are remembered.
template <typename Element>
class Word_values
{
public:
  Word_values(const std::vector<Element>& generators, const Element& identity) : letters_(generators.size(), identity)
  {
    for(std::size_t n = 0; n < generators.size(); ++n)
      letters_.set(std::int32_t(n + 1), generators[n]);
  }

  const Element& operator()(const Word& w)
  {
    const auto found = values_.find(w);
    if(found != values_.end())
      return found->second;
    return values_.emplace(w, letters_(w)).first->second;
  }

private:
  Letter_values<Element> letters_;
  std::map<Word, Element> values_;
};

// A pair of letters that interleave in a word S x P y Q x^-1 R y^-1 Z. The word is the product of a commutator and a word without the two:
//
//   S x P y Q x^-1 R y^-1 Z  =  [a, b] (S R Q P Z)   with  T = R Q,  a = S x (S T)^-1,  b = S T P y Q (S T)^-1;
//   x = S^-1 a S T,  y = P^-1 (S T)^-1 b S T Q^-1.
struct Interleaved_pair
{
  std::int32_t x, y; // letters
  Word s, p, q, r;

  Word st() const { return product(s, r, q); }
  Word a() const { return product(s, Word{x}, inverse(st())); }
  Word b() const { return product(st(), p, Word{y}, q, inverse(st())); }

  // Gives `values` the x and y that belong to a and b, if all others are known.
  template <typename Element>
  void set(const Element& a, const Element& b, Letter_values<Element>& values) const
  {
    const Element to = values(st());
    values.set(x, values(inverse(s)) * a * to);
    values.set(y, values(inverse(p)) * to.inverse() * b * to * values(inverse(q)));
  }
};

// Finds the pair that spans the fewest letters of a word in which each occurs twice, with both signs, and leaves of the word what comes after its
// commutator. Returns whether there is one: there is, if the word is the relation of a closed surface.
// Only pairs are considered that begin with one of the first `most` letters.
inline bool split_off(Word& w, Interleaved_pair& pair, std::size_t most = (std::numeric_limits<std::size_t>::max)())
{
  const std::size_t n = w.size();
  std::map<std::int32_t, std::size_t> place;
  for(std::size_t i = 0; i < n; ++i)
    place[w[i]] = i;
  std::size_t first = n, span = n + 1;
  std::pair<std::size_t, std::size_t> inner(0, 0); // places of y and x^-1
  for(std::size_t i = 0; i < (std::min)(n, most); ++i)
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
  pair.x = w[first];
  pair.y = w[inner.first];
  pair.s.assign(w.begin(), at(first));
  pair.p.assign(at(first + 1), at(inner.first));
  pair.q.assign(at(inner.first + 1), at(inner.second));
  pair.r.assign(at(inner.second + 1), at(last));
  const Word z(at(last + 1), w.end());
  w = product(pair.st(), pair.p, z);
  return true;
}

// The letters of a cyclic word, begun at place n.
inline Word rotated(const Word& w, std::size_t n)
{
  Word result = w;
  std::rotate(result.begin(), result.begin() + std::ptrdiff_t(n), result.end());
  return result;
}

// The pair with the first letter of a word that spans the fewest letters. Returns whether there is one, and then leaves of the word what comes
// after its commutator.
inline bool split_off_first(Word& w, Interleaved_pair& pair)
{
  return split_off(w, pair, 1);
}

// Canonical generators a_1, b_1, ..., a_g, b_g for the generators of a one-relator presentation of the group of a closed surface, as words in
// these: the product of commutators [a_i, b_i] = a_i b_i a_i^-1 b_i^-1 is the relation, begun somewhere else (the normal form of closed surfaces,
// by cutting and pasting; H. R. Brahana, "Systems of circuits on two-dimensional manifolds", 1921). None if the relation is not that of a closed
// orientable surface.
inline std::vector<Word> canonical_generators(Word relation)
{
  std::vector<Word> result;
  Interleaved_pair pair;
  Word rest = relation;
  if(split_off(rest, pair)) // a relation may begin anywhere: what stands before the first pair would conjugate it, and make it long
    relation = rotated(relation, pair.s.size());
  while(!relation.empty())
  {
    if(!split_off(relation, pair))
      return std::vector<Word>();
    result.push_back(pair.a());
    result.push_back(pair.b());
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_WORDS_H
