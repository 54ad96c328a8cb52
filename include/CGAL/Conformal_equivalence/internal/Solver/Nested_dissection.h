// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Divides a graph by separators (A. George, "Nested dissection of a regular finite element mesh", 1973). As for few parts it need not be known
// vertex by vertex where they meet, that is found on clusters of a dozen vertices, of which there are few, and then smoothed.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NESTED_DISSECTION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NESTED_DISSECTION_H

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Each edge is in the lists of both of its ends.
struct Weighted_graph
{
  std::vector<int> first = std::vector<int>(1, 0), neighbor; // by vertex, and the end: its first neighbor
  std::vector<int> edge_weight;                              // by neighbor
  std::vector<int> vertex_weight;

  int size() const { return int(first.size()) - 1; }
};

// Divides the vertices of a graph by halves.
class Graph_bisection
{
public:
  // The number of the part, of 2^levels, of every vertex: the binary digits tell on which side of each separator it is, that of the first one first.
  // It does not depend on the number of threads.
  Graph_bisection(const Weighted_graph& graph, int levels, const Concurrency& concurrency = Concurrency())
    : parts(std::size_t(graph.size()), 0), graph_(graph), set_(parts.size(), none), side_(parts.size(), 0), concurrency_(concurrency)
  {
    std::vector<int> all(parts.size());
    for(std::size_t v = 0; v < all.size(); ++v)
      all[v] = int(v);
    divide(all, levels);
  }

  std::vector<int> parts;

private:
  static constexpr int none = -1;

  void divide(const std::vector<int>& vertices, int levels)
  {
    if(levels == 0 || vertices.empty())
      return;
    bisect(vertices);
    std::vector<int> halves[2];
    for(const int v : vertices)
    {
      parts[v] = 2 * parts[v] + side_[v];
      halves[int(side_[v])].push_back(v);
    }
    if(concurrency_.is_sequential())
      for(const std::vector<int>& half : halves)
        divide(half, levels - 1);
    else
      concurrency_.for_each(2, [&](int i) { divide_apart(halves[i], levels - 1); });
  }

  // The same, with no more than reads of what other threads may read, too: as a graph by itself.
  void divide_apart(const std::vector<int>& vertices, int levels)
  {
    Weighted_graph part;
    std::vector<int> place(std::size_t(graph_.size()), none);
    for(std::size_t i = 0; i < vertices.size(); ++i)
      place[vertices[i]] = int(i);
    for(const int v : vertices)
    {
      for(int k = graph_.first[v]; k < graph_.first[v + 1]; ++k)
        if(place[graph_.neighbor[k]] != none)
        {
          part.neighbor.push_back(place[graph_.neighbor[k]]);
          part.edge_weight.push_back(graph_.edge_weight[k]);
        }
      part.first.push_back(int(part.neighbor.size()));
      part.vertex_weight.push_back(graph_.vertex_weight[v]);
    }
    const std::vector<int> parts_of_half = Graph_bisection(part, levels).parts;
    for(std::size_t i = 0; i < vertices.size(); ++i)
      parts[vertices[i]] = (parts[vertices[i]] << levels) + parts_of_half[i];
  }

  // Of two vertices that are apart, one half is nearer to the first one. Corners of a square are apart, but so are opposite ones, and the way
  // between the latter is longer to cut: of several pairs the best is taken.
  void bisect(const std::vector<int>& vertices)
  {
    ++number_of_sets_;
    for(const int v : vertices)
      set_[v] = number_of_sets_;
    const int a = distances(vertices, vertices.front()).second;
    const Distances from_a = distances(vertices, a), from_b = distances(vertices, from_a.second);
    std::size_t middle = 0;
    for(std::size_t i = 1; i < vertices.size(); ++i)
      if((std::min)(from_a.first[i], from_b.first[i]) > (std::min)(from_a.first[middle], from_b.first[middle]))
        middle = i;
    const Distances from_c = distances(vertices, vertices[middle]), from_d = distances(vertices, from_c.second);
    std::vector<char> best;
    long least = 0;
    const Distances* const pairs[][2] = {{&from_a, &from_b}, {&from_a, &from_c}, {&from_b, &from_c}, {&from_c, &from_d}};
    for(const auto& pair : pairs)
    {
      halve(vertices, pair[0]->first, pair[1]->first);
      const long cut = weight_of_cut(vertices);
      if(!best.empty() && cut >= least)
        continue;
      least = cut;
      best.clear();
      for(const int v : vertices)
        best.push_back(side_[v]);
    }
    for(std::size_t i = 0; i < vertices.size(); ++i)
      side_[vertices[i]] = best[i];
    smooth(vertices);
  }

  typedef std::pair<std::vector<int>, int> Distances; // of `vertices` from one of them, and which one is the farthest

  // Components that cannot be reached come one behind the other.
  Distances distances(const std::vector<int>& vertices, int from)
  {
    distance_.resize(set_.size());
    queue_.clear();
    const int seen = ++number_of_sets_;
    const auto enter = [&](int v, int distance)
    {
      set_[v] = seen;
      distance_[v] = distance;
      queue_.push_back(v);
    };
    enter(from, 0);
    std::size_t done = 0, next = 0;
    while(queue_.size() < vertices.size())
    {
      for(; done < queue_.size(); ++done)
        for(int k = graph_.first[queue_[done]]; k < graph_.first[queue_[done] + 1]; ++k)
          if(set_[graph_.neighbor[k]] == seen - 1)
            enter(graph_.neighbor[k], distance_[queue_[done]] + 1);
      while(next < vertices.size() && set_[vertices[next]] == seen)
        ++next;
      if(next < vertices.size())
        enter(vertices[next], distance_[queue_.back()] + 1);
    }
    Distances result;
    result.second = queue_.back();
    for(const int v : vertices)
      result.first.push_back(distance_[v]);
    return result;
  }

  // Those go to one side that are nearer to the first than to the second vertex, as compared with the others, and have half of the weight.
  void halve(const std::vector<int>& vertices, const std::vector<int>& from_first, const std::vector<int>& from_second)
  {
    const int largest = *std::max_element(from_first.begin(), from_first.end()) + *std::max_element(from_second.begin(), from_second.end());
    std::vector<long> weight(2 * std::size_t(largest) + 1, 0);
    long all = 0;
    for(std::size_t i = 0; i < vertices.size(); ++i)
    {
      weight[from_first[i] - from_second[i] + largest] += graph_.vertex_weight[vertices[i]];
      all += graph_.vertex_weight[vertices[i]];
    }
    int limit = 0;
    long below = 0;
    while(2 * (below + weight[limit]) < all)
      below += weight[limit++];
    for(std::size_t i = 0; i < vertices.size(); ++i)
    {
      const int key = from_first[i] - from_second[i] + largest;
      const bool is_below = key < limit || (key == limit && 2 * below < all);
      side_[vertices[i]] = is_below ? 0 : 1;
      if(key == limit && is_below)
        below += graph_.vertex_weight[vertices[i]];
    }
  }

  // What the edges of v to either side weigh.
  std::pair<long, long> edges_to_sides(int v) const
  {
    std::pair<long, long> result(0, 0);
    for(int k = graph_.first[v]; k < graph_.first[v + 1]; ++k)
      if(set_[graph_.neighbor[k]] == set_[v])
        (side_[graph_.neighbor[k]] == 0 ? result.first : result.second) += graph_.edge_weight[k];
    return result;
  }

  long weight_of_cut(const std::vector<int>& vertices) const
  {
    long result = 0;
    for(const int v : vertices)
      if(side_[v] == 0)
        result += edges_to_sides(v).second;
    return result;
  }

  // Moves vertices to the side to which more of their edges lead, as far as the sides remain about equal.
  void smooth(const std::vector<int>& vertices)
  {
    const int most_sweeps = 10;
    long weight[2] = {0, 0};
    for(const int v : vertices)
      weight[int(side_[v])] += graph_.vertex_weight[v];
    const long most = (weight[0] + weight[1]) / 50 * 26; // half, and a twenty-fifth of it
    bool is_changed = true;
    for(int sweep = 0; sweep < most_sweeps && is_changed; ++sweep)
    {
      is_changed = false;
      for(const int v : vertices)
      {
        const std::pair<long, long> edges = edges_to_sides(v);
        const int own = side_[v], other = 1 - own;
        const long gain = own == 0 ? edges.second - edges.first : edges.first - edges.second;
        if(gain <= 0 || weight[other] + graph_.vertex_weight[v] > most)
          continue;
        weight[own] -= graph_.vertex_weight[v];
        weight[other] += graph_.vertex_weight[v];
        side_[v] = char(other);
        is_changed = true;
      }
    }
  }

  const Weighted_graph& graph_;
  std::vector<int> set_;     // by vertex: the last set that it was in
  int number_of_sets_ = 0;
  std::vector<char> side_;
  std::vector<int> distance_, queue_;
  const Concurrency concurrency_;
};

class Nested_dissection
{
public:
  // By separators that depend on nothing but the graph, given by `first` and `neighbor` as in `Weighted_graph`, into 2^levels parts.
  // They do not depend on the number of threads, either.
  Nested_dissection(const std::vector<int>& first, const std::vector<int>& neighbor, int levels, const Concurrency& concurrency = Concurrency())
    : first_(first), neighbor_(neighbor), levels_(levels)
  {
    grow_clusters();
    const std::vector<int> parts = Graph_bisection(graph_of_clusters(), levels, concurrency).parts;
    part_.reserve(first.size() - 1);
    for(const int c : cluster_)
      part_.push_back(parts[c]);
    smooth();
    find_separators();
  }

  // The vertices of every set: parts, and separators behind what they separate. In which order, does not matter otherwise.
  std::vector<std::vector<int> > sets() const
  {
    std::vector<std::vector<int> > of_node(std::size_t(2) << levels_), result;
    for(int v = 0; v < int(part_.size()); ++v)
      of_node[node(v)].push_back(v);
    for(std::size_t n = of_node.size(); n-- > 1; ) // from the leaves of the tree to the root, which is 1
      result.push_back(std::move(of_node[n]));
    return result;
  }

  std::size_t number_of_parts() const { return std::size_t(1) << levels_; } // which are the first sets
  std::size_t number_of_separating_vertices() const { return number_of_separating_; }

private:
  static constexpr int none = -1;

  // In the tree of separators, in which n has the children 2n and 2n + 1.
  std::size_t node(int v) const { return (std::size_t(1) << level_[v]) + std::size_t(part_[v] >> (levels_ - level_[v])); }

  // By breadth-first searches, each of which begins beside an earlier one.
  void grow_clusters()
  {
    const std::size_t most = 12;
    cluster_.assign(first_.size() - 1, none);
    std::vector<int> fringe, members;
    std::size_t next_in_fringe = 0;
    for(int v = 0; v < int(cluster_.size()); )
    {
      int seed = v;
      while(next_in_fringe < fringe.size() && cluster_[fringe[next_in_fringe]] != none)
        ++next_in_fringe;
      if(next_in_fringe < fringe.size())
        seed = fringe[next_in_fringe];
      else if(cluster_[v] != none)
      {
        ++v;
        continue;
      }
      members.assign(1, seed);
      cluster_[seed] = number_of_clusters_;
      for(std::size_t i = 0; i < members.size(); ++i)
        for(int k = first_[members[i]]; k < first_[members[i] + 1]; ++k)
        {
          const int w = neighbor_[k];
          if(cluster_[w] != none)
            continue;
          if(members.size() == most)
          {
            fringe.push_back(w);
            continue;
          }
          cluster_[w] = number_of_clusters_;
          members.push_back(w);
        }
      ++number_of_clusters_;
    }
  }

  Weighted_graph graph_of_clusters() const
  {
    std::vector<int> first(std::size_t(number_of_clusters_) + 1, 0), member(cluster_.size()), place(std::size_t(number_of_clusters_), none);
    for(const int c : cluster_)
      ++first[c + 1];
    Weighted_graph result;
    result.vertex_weight.assign(first.begin() + 1, first.end());
    for(int c = 0; c < number_of_clusters_; ++c)
      first[c + 1] += first[c];
    std::vector<int> free_place(first.begin(), first.end() - 1);
    for(int v = 0; v < int(cluster_.size()); ++v)
      member[free_place[cluster_[v]]++] = v;
    for(int c = 0; c < number_of_clusters_; ++c)
    {
      for(int i = first[c]; i < first[c + 1]; ++i)
        for(int k = first_[member[i]]; k < first_[member[i] + 1]; ++k)
        {
          const int d = cluster_[neighbor_[k]];
          if(d == c)
            continue;
          if(place[d] < result.first.back())
          {
            place[d] = int(result.neighbor.size());
            result.neighbor.push_back(d);
            result.edge_weight.push_back(0);
          }
          ++result.edge_weight[place[d]];
        }
      result.first.push_back(int(result.neighbor.size()));
    }
    return result;
  }

  // Vertices go to the part in which most of their neighbors are: clusters have ragged borders. What has very many neighbors remains where it is, as
  // counting takes the square of their number.
  void smooth()
  {
    const int sweeps = 3, very_many = 64;
    for(int sweep = 0; sweep < sweeps; ++sweep)
      for(int v = 0; v < int(part_.size()); ++v)
      {
        const int degree = first_[v + 1] - first_[v];
        if(degree > very_many)
          continue;
        int best = part_[v], most = count_neighbors_in(v, best);
        if(most == degree)
          continue;
        for(int k = first_[v]; k < first_[v + 1]; ++k)
        {
          const int part = part_[neighbor_[k]], number = part == best ? 0 : count_neighbors_in(v, part);
          if(number > most)
          {
            best = part;
            most = number;
          }
        }
        part_[v] = best;
      }
  }

  int count_neighbors_in(int v, int part) const
  {
    int result = 0;
    for(int k = first_[v]; k < first_[v + 1]; ++k)
      if(part_[neighbor_[k]] == part)
        ++result;
    return result;
  }

  // A separator is made of the vertices of one of the two sides that have neighbors on the other one, whichever are fewer.
  void find_separators()
  {
    level_.assign(part_.size(), levels_);
    std::vector<std::vector<std::pair<int, int> > > cut(static_cast<std::size_t>(levels_)); // edges by level, from the side 0 to the side 1
    for(int v = 0; v < int(part_.size()); ++v)
      for(int k = first_[v]; k < first_[v + 1]; ++k)
        if(part_[v] < part_[neighbor_[k]])
        {
          int level = levels_ - 1;
          for(int different = part_[v] ^ part_[neighbor_[k]]; different > 1; different /= 2)
            --level;
          cut[level].emplace_back(v, neighbor_[k]);
        }
    std::vector<int> last(part_.size(), none);
    for(int level = 0; level < levels_; ++level)
    {
      const auto is_cut = [&](const std::pair<int, int>& edge) { return level_[edge.first] >= level && level_[edge.second] >= level; };
      const auto separator = [&](int v) { return std::size_t(part_[v] >> (levels_ - level)); };
      std::vector<int> excess(std::size_t(1) << level, 0); // of vertices on the side 0
      for(const std::pair<int, int>& edge : cut[level])
        if(is_cut(edge))
        {
          excess[separator(edge.first)] += std::exchange(last[edge.first], level) != level ? 1 : 0;
          excess[separator(edge.first)] -= std::exchange(last[edge.second], level) != level ? 1 : 0;
        }
      for(const std::pair<int, int>& edge : cut[level])
        if(is_cut(edge))
        {
          const int v = excess[separator(edge.first)] <= 0 ? edge.first : edge.second;
          number_of_separating_ += level_[v] != level ? 1 : 0;
          level_[v] = level;
        }
    }
  }

  const std::vector<int>& first_;
  const std::vector<int>& neighbor_;
  int levels_, number_of_clusters_ = 0;
  std::size_t number_of_separating_ = 0;
  std::vector<int> cluster_, part_;
  std::vector<int> level_; // of the separator that the vertex is in, or `levels_`
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NESTED_DISSECTION_H
