from typing import Any, Callable, Optional, Tuple

import numpy as np

version: str

class Stream:
    rows: int
    cols: int
    width: int
    height: int
    depth: int
    tree_height: int
    block_size: int
    profile: str
    features: list[str]
    @staticmethod
    def from_file(path: str, check_sections: bool) -> Stream: ...
    @staticmethod
    def from_buffer(buffer: Any, check_sections: bool) -> Stream: ...
    def pixels(
        self, row: int, col: int, x: int, y: int, width: int, height: int, stop_level: int
    ) -> np.ndarray: ...
    def block(
        self, row: int, col: int, plane: str, bx: int, by: int, stop_level: int, traced: bool
    ) -> Any: ...
    def disparity(self, row: int, col: int) -> Tuple[np.ndarray, np.ndarray]: ...
    def rig(self) -> Optional[Tuple[Optional[float], list, list, list]]: ...
    def render(self, *arguments: Any) -> np.ndarray: ...

def encode(views: np.ndarray, *arguments: Any) -> bytes: ...
def read_views(folder: str, grid: Optional[Tuple[int, int]]) -> Tuple[np.ndarray, int]: ...
