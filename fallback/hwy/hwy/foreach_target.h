// Highway includes each file once more for every instruction set; without it there is one.
#pragma once
