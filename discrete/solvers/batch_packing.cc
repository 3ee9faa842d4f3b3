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
  bool BatchedContacts::cut(const std::vector<Ends> &rows, const int n_blocks)
  {
    if (n_blocks == 1)
      {
        blocks_.push_back(make_part(rows));
        return true;
      }
    const std::size_t n_bodies = problem_.free_velocity.size();
    std::vector<int>  first(n_bodies, n_blocks), last(n_bodies, -1), gap_of(n_bodies, -1);
    const auto        block_of = [&](const std::size_t k) { return int(k * n_blocks / rows.size()); };
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const int body : {rows[k].i, rows[k].j})
        if (body >= 0)
          {
            first[body] = std::min(first[body], block_of(k));
            last[body]  = std::max(last[body], block_of(k));
          }
    std::vector<std::vector<Ends>> inside(n_blocks), gaps(n_blocks - 1);
    for (const Ends &row : rows)
      {
        int from = n_blocks, to = -1;
        for (const int body : {row.i, row.j})
          if (body >= 0)
            {
              from = std::min(from, first[body]);
              to   = std::max(to, last[body]);
            }
        if (from == to)
          inside[from].push_back(row);
        else if (to == from + 1)
          gaps[from].push_back(row);
        else
          return false;
        if (from != to)
          for (const int body : {row.i, row.j})
            if (body >= 0)
              {
                if (gap_of[body] >= 0 && gap_of[body] != from)
                  return false;
                gap_of[body] = from;
              }
      }
    for (const std::vector<Ends> &part : inside)
      blocks_.push_back(make_part(part));
    for (const std::vector<Ends> &part : gaps)
      between_.push_back(make_part(part));
    return true;
  }

  // First fit. A batch takes, from a window of 64 waiting rows, the oldest ones that share no moving body. If possible they
  // share no moving body with the previous batch either: then the sweep need not wait for its velocities.
  BatchedContacts::Part BatchedContacts::make_part(const std::vector<Ends> &rows)
  {
    std::vector<int> own; // immovable bodies, each with a private copy
    Part             part;
    part.idle_body = int(v_.size());
    v_.push_back({0, 0, 0, 0});
    part.batches.reserve(rows.size() / 3 + 2);
    part.rows.reserve(rows.size() / 3 + 2);
    std::vector<Ends> awake, idle;
    awake.reserve(rows.size());
    for (const Ends &row : rows)
      (is_idle_[row.row] ? idle : awake).push_back(row);
    pack(awake, part, own);
    part.n_awake = part.batches.size();
    pack(idle, part, own);
    return part;
  }

  void BatchedContacts::pack(const std::vector<Ends> &rows, Part &part, std::vector<int> &own)
  {
    constexpr int      window_size = 64;
    const int          n = int(rows.size()), first_own = part.idle_body + 1;
    const ContactBatch empty = empty_batch(part.idle_body);
    const auto         place = [&](const int body) {
      if (body >= 0)
        return body;
      const auto known = std::find(own.begin(), own.end(), body);
      if (known != own.end())
        return first_own + int(known - own.begin());
      own.push_back(body);
      v_.push_back(problem_.free_velocity[-1 - body]);
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
        if (has_terms_)
          part.terms.push_back({});
        if (has_couples_)
          part.rolling.push_back({});
        int filled = 0;
        for (const int distance : {1, 0})
          for (int before = 0; after[before] < entered && filled < lanes;)
            {
              const int   k     = after[before];
              const Ends &ends  = rows[k];
              const auto  taken = [&](const int body) { return body >= 0 && batch_of_[body] >= batch - distance; };
              if (taken(ends.i) || taken(ends.j))
                {
                  before = k + 1;
                  continue;
                }
              for (const int body : {ends.i, ends.j})
                if (body >= 0)
                  batch_of_[body] = batch;
              fill_lane(part, filled, ends.row);
              part.batches.back().i[filled] = place(ends.i);
              part.batches.back().j[filled] = place(ends.j);
              after[before]                 = after[k + 1];
              ++filled;
              ++taken_rows;
              --waiting;
            }
      }
    for (const Ends &row : rows)
      for (const int body : {row.i, row.j})
        if (body >= 0)
          batch_of_[body] = -2;
  }

  void BatchedContacts::fill_lane(Part &part, const int lane, const int row) const
  {
    const ContactRow &c    = problem_.contacts[row];
    ContactBatch     &data = part.batches.back();
    data.nx[lane]          = c.nx;
    data.ny[lane]          = c.ny;
    data.normal_term[lane] = c.normal_term;
    data.friction[lane]    = c.friction;
    data.inverse_wnn[lane] = c.inverse_wnn;
    part.rows.back()[lane] = row;
    if (has_terms_)
      {
        TermBatch &terms                  = part.terms.back();
        terms.tangential_term[lane]       = c.tangential_term;
        terms.inverse_wtt[lane]           = c.inverse_wtt;
        terms.normal_compliance[lane]     = c.normal_compliance;
        terms.tangential_compliance[lane] = c.tangential_compliance;
        terms.rolling_term[lane]          = c.rolling_term;
      }
    if (has_couples_)
      {
        RollingBatch &couples     = part.rolling.back();
        couples.friction[lane]    = c.rolling_friction;
        couples.arm[lane]         = c.rolling_arm;
        couples.inverse_wmm[lane] = c.inverse_wmm;
      }
  }
} // namespace diptych::discrete
