"""The structs of roam/roam.h. tests/python compares their layout with that of C."""

import ctypes
from typing import Any

PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_double, ctypes.c_void_p)


class _Sized(ctypes.Structure):
    """A struct that carries its size."""

    def __init__(self, **values: Any) -> None:
        super().__init__(**values)
        self.size = ctypes.sizeof(self)


class Vec3(ctypes.Structure):
    _fields_ = [("x", ctypes.c_double), ("y", ctypes.c_double), ("z", ctypes.c_double)]


class Mesh(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("name", ctypes.c_char_p), ("vertices", ctypes.c_void_p),
                ("vertex_count", ctypes.c_size_t), ("vertex_stride", ctypes.c_ssize_t),
                ("triangles", ctypes.c_void_p), ("triangle_count", ctypes.c_size_t),
                ("triangle_stride", ctypes.c_ssize_t)]


class WorldOptions(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("threads", ctypes.c_int32), ("lossless", ctypes.c_int32),
                ("up", ctypes.c_char_p), ("unit", ctypes.c_char_p), ("progress", PROGRESS),
                ("progress_data", ctypes.c_void_p)]


class StoreOptions(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("memory", ctypes.c_uint64), ("loaders", ctypes.c_int32),
                ("reserved", ctypes.c_int32), ("horizon", ctypes.c_double), ("cache", ctypes.c_char_p),
                ("cache_bytes", ctypes.c_uint64), ("patience", ctypes.c_double), ("redirects", ctypes.c_int32),
                ("reserved_2", ctypes.c_int32), ("progress", PROGRESS), ("progress_data", ctypes.c_void_p)]


class Facts(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("lower", Vec3), ("upper", Vec3), ("triangles", ctypes.c_uint64),
                ("objects", ctypes.c_uint64), ("bytes", ctypes.c_uint64), ("largest_error", ctypes.c_double),
                ("speed_limit", ctypes.c_double), ("failed", ctypes.c_uint64), ("ready", ctypes.c_double)]


class Query(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("from", Vec3), ("motion", Vec3), ("radius", ctypes.c_double),
                ("half_height", ctypes.c_double), ("ignored", ctypes.c_void_p), ("ignored_count", ctypes.c_size_t)]


class Impact(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("time", ctypes.c_double), ("gap", ctypes.c_double), ("point", Vec3),
                ("normal", Vec3), ("triangle", ctypes.c_uint64), ("object", ctypes.c_uint32),
                ("hit", ctypes.c_uint8), ("unknown", ctypes.c_uint8), ("feature", ctypes.c_uint8),
                ("reserved", ctypes.c_uint8)]


class Contact(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("gap", ctypes.c_double), ("point", Vec3), ("normal", Vec3),
                ("triangle", ctypes.c_uint64), ("object", ctypes.c_uint32), ("found", ctypes.c_uint8),
                ("unknown", ctypes.c_uint8), ("feature", ctypes.c_uint8), ("reserved", ctypes.c_uint8)]


class Input(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("stride", ctypes.c_ssize_t)]


class Output(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("stride", ctypes.c_ssize_t)]


class Batch(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("count", ctypes.c_size_t), ("from", Input), ("motion", Input),
                ("radius", Input), ("half_height", Input), ("ignored", ctypes.c_void_p),
                ("ignored_count", ctypes.c_size_t), ("reach", ctypes.c_double), ("most", ctypes.c_size_t),
                ("hit", Output), ("time", Output), ("gap", Output), ("point", Output), ("normal", Output),
                ("triangle", Output), ("object", Output), ("feature", Output), ("unknown", Output),
                ("found", Output), ("progress", PROGRESS), ("progress_data", ctypes.c_void_p)]


class WalkerSettings(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("radius", ctypes.c_double), ("height", ctypes.c_double),
                ("eye", ctypes.c_double), ("step", ctypes.c_double), ("slope_degrees", ctypes.c_double),
                ("support_radius", ctypes.c_double), ("gravity", ctypes.c_double), ("jump_height", ctypes.c_double),
                ("crouch_height", ctypes.c_double), ("clearance_reach", ctypes.c_double)]


class WalkerInput(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("velocity", Vec3), ("acceleration", ctypes.c_double),
                ("braking", ctypes.c_double), ("jump", ctypes.c_int32), ("crouch", ctypes.c_int32)]


class Step(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("from", Vec3), ("to", Vec3), ("radius", ctypes.c_double),
                ("height", ctypes.c_double), ("gap", ctypes.c_double), ("least_gap", ctypes.c_double),
                ("length", ctypes.c_double), ("elapsed", ctypes.c_double), ("landing_speed", ctypes.c_double),
                ("blocked_by", ctypes.c_uint64), ("events", ctypes.c_uint32), ("grounded", ctypes.c_uint8),
                ("blocked", ctypes.c_uint8), ("held", ctypes.c_uint8), ("unknown", ctypes.c_uint8)]


class WalkerState(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("position", Vec3), ("feet", Vec3), ("eye", Vec3), ("velocity", Vec3),
                ("radius", ctypes.c_double), ("height", ctypes.c_double), ("rise_speed", ctypes.c_double),
                ("skin", ctypes.c_double), ("mode", ctypes.c_int32), ("grounded", ctypes.c_uint8),
                ("crouched", ctypes.c_uint8), ("held", ctypes.c_uint8), ("reserved", ctypes.c_uint8)]


class RouteOptions(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("speed", ctypes.c_double), ("dt", ctypes.c_double),
                ("patience", ctypes.c_double), ("wait", ctypes.c_double), ("progress", PROGRESS),
                ("progress_data", ctypes.c_void_p)]


class RouteResult(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("outcome", ctypes.c_int32), ("reserved", ctypes.c_int32),
                ("waypoints", ctypes.c_uint64), ("steps", ctypes.c_uint64), ("length", ctypes.c_double),
                ("simulated", ctypes.c_double), ("least_gap", ctypes.c_double), ("end", Vec3),
                ("blocked_by", ctypes.c_uint64), ("blocked_at", Vec3), ("opening", ctypes.c_double)]


class ProbeOptions(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("from", Vec3), ("to", Vec3), ("radius", ctypes.c_double),
                ("height", ctypes.c_double), ("mode", ctypes.c_int32), ("reserved", ctypes.c_int32),
                ("step", ctypes.c_double), ("spacing", ctypes.c_double), ("progress", PROGRESS),
                ("progress_data", ctypes.c_void_p)]


class ProbeAnswer(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("passable", ctypes.c_uint8), ("wide_enough", ctypes.c_uint8),
                ("proven", ctypes.c_uint8), ("found", ctypes.c_uint8), ("limit", ctypes.c_int32),
                ("widest_radius", ctypes.c_double), ("length", ctypes.c_double), ("limit_point", Vec3),
                ("limit_direction", Vec3), ("limit_size", ctypes.c_double), ("limit_needed", ctypes.c_double)]


class TrainOptions(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("mode", ctypes.c_int32), ("paths", ctypes.c_int32),
                ("seed", ctypes.c_uint64), ("height", ctypes.c_double), ("radius_min", ctypes.c_double),
                ("radius_max", ctypes.c_double), ("spacing", ctypes.c_double), ("threads", ctypes.c_int32),
                ("reserved", ctypes.c_int32), ("progress", PROGRESS), ("progress_data", ctypes.c_void_p)]


class Training(_Sized):
    _fields_ = [("size", ctypes.c_size_t), ("radius", ctypes.c_double), ("height", ctypes.c_double),
                ("support_radius", ctypes.c_double), ("step", ctypes.c_double), ("slope_degrees", ctypes.c_double),
                ("smallest", ctypes.c_double), ("largest", ctypes.c_double), ("paths", ctypes.c_uint64),
                ("cracks", ctypes.c_uint64), ("places", ctypes.c_uint64), ("feasible", ctypes.c_uint8),
                ("complete", ctypes.c_uint8), ("reserved", ctypes.c_uint8 * 6)]
