#include "render/cloud/slab_table.h"

namespace skyig::render::cloud {

const std::array<LeavingTable::Medium, 6> kLeavingTables{{
#include "render/cloud/data/slab_leaving.inc"
}};

const std::array<InsideTable::Medium, 2> kInsideTables{{
#include "render/cloud/data/slab_inside.inc"
}};

}  // namespace skyig::render::cloud
