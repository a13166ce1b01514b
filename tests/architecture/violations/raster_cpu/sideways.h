#pragma once

#include "core/mesh/libraries.h"
