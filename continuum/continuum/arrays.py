"""The array type of the library's signatures."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
