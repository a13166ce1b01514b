#pragma once

#include "core/view/view.h"
