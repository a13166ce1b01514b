#include "raster_cpu/cpu_rasterizer.h"
