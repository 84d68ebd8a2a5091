/// The CSV files and the report on Choi & Sung.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/choi_sung/contact_levels.h"
#include "bench/experiments/papers/claims.h"
#include "bench/experiments/papers/frontier.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::papers {

/// Table 1 in full, with what it leaves out: one row a surface, without and with clustering.
support::Table choi_sung_table1(const ChoiSungResult& result);
/// The paper's own columns for a reader, the best of each level in bold.
support::Table choi_sung_table1_short(const ChoiSungResult& result);
/// The scores; empty unless the run was finished.
support::Table choi_sung_table2(const ChoiSungResult& result);
/// LS3 without and with clustering, and the reduction ratios.
support::Table choi_sung_table3(const ChoiSungResult& result);
/// Compares the exact fast forms on these queries, and says how many times the published scan's update rate
/// they hold.
support::Table choi_sung_fast_table(const ChoiSungResult& result);

/// Tests and time by the distance of clustering, and the paper's statements on other models.
support::Table choi_sung_distances(const ChoiSungResult& result);
support::Table choi_sung_models(const ChoiSungResult& result);

/// Number by number. `own_mesh`: it is the mesh of the paper.
std::vector<Claim> choi_sung_claims(const ChoiSungResult& result, bool own_mesh);

/// What the paper says of shapes, counts and their order, which needs no time and no printed number: to be
/// asked of other models, too. Empty unless all methods and levels were measured.
std::vector<Claim> choi_sung_statements(const ChoiSungResult& result);

/// The triangles of every surface, beside what the paper's tool makes of the paper's mesh: not printed but
/// for LS3.
std::vector<Claim> choi_sung_tool_counts(const ChoiSungResult& result, bool own_mesh);

/// report.md.
std::string choi_sung_report(const PaperMesh& mesh, const ChoiSungSettings& settings,
                             const ChoiSungResult& result, const FrontierResult& frontier,
                             const ContactLevelResult& levels);

}  // namespace touchmark::bench::experiments::papers
