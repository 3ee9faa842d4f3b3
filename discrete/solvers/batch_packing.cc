// diptych: contacts cut into blocks and packed into batches
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "discrete/contacts/contact_law.h"
#include "discrete/solvers/batched_sweep.h"

namespace diptych::discrete
{
  namespace
  {
    ContactBatch empty_batch(const int idle_body)
    {
      ContactBatch batch{};
      std::fill_n(batch.i, lanes, idle_body);
      std::fill_n(batch.j, lanes, idle_body);
      return batch;
    }
  } // namespace

  bool BatchedContacts::fits_a_batch(const ContactRow &c) const
  {
    const double wi = problem_.free_velocity[c.i].inverse_mass, wj = problem_.free_velocity[c.j].inverse_mass;
    const auto   same = [](const double a, const double b) {
      return std::abs(a - b) <= 1e-14 * std::abs(b);
    }; // files round these numbers
    return c.image_body < 0 && same(c.jx, wj) && same(c.jy, wj) && same(c.ki, 2 * wi) && same(c.kj, 2 * wj) &&
           (c.normal_compliance > 0 || same(c.inverse_wtt, c.inverse_wnn * disc_wnn_over_wtt));
  }

  // False: a contact would join blocks that are not neighbours, or a body has contacts in two gaps between blocks.
  bool BatchedContacts::cut(const std::vector<int> &rows, const int n_blocks)
  {
    const std::size_t n_bodies = problem_.free_velocity.size();
    std::vector<int>  first(n_bodies, n_blocks), last(n_bodies, -1), gap_of(n_bodies, -1);
    const auto        block_of = [&](const std::size_t k) { return int(k * n_blocks / rows.size()); };
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const int body : {problem_.contacts[rows[k]].i, problem_.contacts[rows[k]].j})
        if (moves(problem_, body))
          {
            first[body] = std::min(first[body], block_of(k));
            last[body]  = std::max(last[body], block_of(k));
          }
    std::vector<std::vector<int>> inside(n_blocks), gaps(n_blocks - 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        const ContactRow &c    = problem_.contacts[rows[k]];
        int               from = n_blocks, to = -1;
        for (const int body : {c.i, c.j})
          if (moves(problem_, body))
            {
              from = std::min(from, first[body]);
              to   = std::max(to, last[body]);
            }
        if (from == to)
          inside[from].push_back(rows[k]);
        else if (to == from + 1)
          gaps[from].push_back(rows[k]);
        else
          return false;
        if (from != to)
          for (const int body : {c.i, c.j})
            if (moves(problem_, body))
              {
                if (gap_of[body] >= 0 && gap_of[body] != from)
                  return false;
                gap_of[body] = from;
              }
      }
    for (const std::vector<int> &part : inside)
      blocks_.push_back(make_part(part));
    for (const std::vector<int> &part : gaps)
      between_.push_back(make_part(part));
    return true;
  }

  // First fit. A batch takes, from a window of 64 waiting rows, the oldest ones that share no moving body. If possible they
  // share no moving body with the previous batch either: then the sweep need not wait for its velocities.
  BatchedContacts::Part BatchedContacts::make_part(const std::vector<int> &rows)
  {
    std::vector<int> own; // immovable bodies, each with a private copy
    Part             part;
    part.idle_body = int(v_.size());
    v_.push_back({0, 0, 0, 0});
    part.batches.reserve(rows.size() / 3 + 2);
    part.rows.reserve(rows.size() / 3 + 2);
    part.terms.reserve(rows.size() / 3 + 2);
    std::vector<int> awake, idle;
    for (const int row : rows)
      (is_idle_[row] ? idle : awake).push_back(row);
    pack(awake, part, own);
    part.n_awake = part.batches.size();
    pack(idle, part, own);
    if (std::all_of(rows.begin(), rows.end(), [&](const int row) {
          return problem_.contacts[row].tangential_term == 0 && problem_.contacts[row].normal_compliance == 0;
        }))
      part.terms.clear();
    if (std::any_of(rows.begin(), rows.end(), [&](const int row) { return problem_.contacts[row].rolling_friction != 0; }))
      add_couples(part);
    return part;
  }

  void BatchedContacts::pack(const std::vector<int> &rows, Part &part, std::vector<int> &own)
  {
    constexpr int      window_size = 64;
    const int          n = int(rows.size()), first_own = part.idle_body + 1;
    const ContactBatch empty = empty_batch(part.idle_body);
    const auto         place = [&](const int body) {
      if (moves(problem_, body))
        return body;
      const auto known = std::find(own.begin(), own.end(), body);
      if (known != own.end())
        return first_own + int(known - own.begin());
      own.push_back(body);
      v_.push_back(problem_.free_velocity[body]);
      return int(v_.size()) - 1;
    };

    // Waiting rows as a linked list: after[k + 1] follows row k, and after[0] is the oldest row.
    std::vector<int> after(n + 1);
    std::iota(after.begin(), after.end(), 0);
    int waiting = 0, entered = 0, taken_rows = 0;
    for (int batch = 0; taken_rows < n; ++batch)
      {
        entered = std::min(n, entered + window_size - waiting);
        waiting = entered - taken_rows;
        part.batches.push_back(empty);
        part.rows.push_back({-1, -1, -1, -1});
        part.terms.push_back({});
        int filled = 0;
        for (const int distance : {1, 0})
          for (int before = 0; after[before] < entered && filled < lanes;)
            {
              const int         k = after[before];
              const ContactRow &c = problem_.contacts[rows[k]];
              const auto taken    = [&](const int body) { return moves(problem_, body) && batch_of_[body] >= batch - distance; };
              if (taken(c.i) || taken(c.j))
                {
                  before = k + 1;
                  continue;
                }
              batch_of_[c.i] = batch_of_[c.j] = batch;
              fill_lane(part, filled, rows[k]);
              part.batches.back().i[filled] = place(c.i);
              part.batches.back().j[filled] = place(c.j);
              after[before]                 = after[k + 1];
              ++filled;
              ++taken_rows;
              --waiting;
            }
      }
    for (const int row : rows)
      batch_of_[problem_.contacts[row].i] = batch_of_[problem_.contacts[row].j] = -2;
  }

  void BatchedContacts::fill_lane(Part &part, const int lane, const int row) const
  {
    const ContactRow &c               = problem_.contacts[row];
    ContactBatch     &data            = part.batches.back();
    data.nx[lane]                     = c.nx;
    data.ny[lane]                     = c.ny;
    data.normal_term[lane]            = c.normal_term;
    data.friction[lane]               = c.friction;
    data.inverse_wnn[lane]            = c.inverse_wnn;
    part.rows.back()[lane]            = row;
    TermBatch &terms                  = part.terms.back();
    terms.tangential_term[lane]       = c.tangential_term;
    terms.inverse_wtt[lane]           = c.inverse_wtt;
    terms.normal_compliance[lane]     = c.normal_compliance;
    terms.tangential_compliance[lane] = c.tangential_compliance;
    terms.rolling_term[lane]          = c.rolling_term;
  }

  void BatchedContacts::add_couples(Part &part) const
  {
    part.rolling.resize(part.batches.size());
    for (std::size_t b = 0; b < part.rows.size(); ++b)
      for (int lane = 0; lane < lanes; ++lane)
        if (const int row = part.rows[b][lane]; row >= 0)
          {
            const ContactRow &c               = problem_.contacts[row];
            part.rolling[b].friction[lane]    = c.rolling_friction;
            part.rolling[b].arm[lane]         = c.rolling_arm;
            part.rolling[b].inverse_wmm[lane] = c.inverse_wmm;
          }
  }
} // namespace diptych::discrete
