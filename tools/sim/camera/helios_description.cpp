// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/camera/helios_description.hpp"

#include <array>
#include <cstdio>
#include <vector>

#include "host/device/pixel_format.hpp"

namespace pharos::sim {
namespace {

std::string hex(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%x", value);
  return text.data();
}

std::string int_register(const std::string& name, std::uint32_t address, const char* access = "RW") {
  return "<IntReg Name=\"" + name + "\"><Address>" + hex(address) + "</Address><Length>4</Length><AccessMode>" +
         access + "</AccessMode><pPort>Device</pPort><Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>\n";
}

std::string text_register(const std::string& name, std::uint32_t address, int length) {
  return "<StringReg Name=\"" + name + "\"><Address>" + hex(address) + "</Address><Length>" + std::to_string(length) +
         "</Length><AccessMode>RO</AccessMode><pPort>Device</pPort></StringReg>\n";
}

std::string integer(const std::string& name, std::uint32_t address, const std::string& limits,
                    const char* access = "RW") {
  return "<Integer Name=\"" + name + "\"><pValue>" + name + "Register</pValue>" + limits + "</Integer>\n" +
         int_register(name + "Register", address, access);
}

std::string boolean(const std::string& name, std::uint32_t address) {
  return "<Boolean Name=\"" + name + "\"><pValue>" + name +
         "Register</pValue><OnValue>1</OnValue><OffValue>0</OffValue></Boolean>\n" +
         int_register(name + "Register", address);
}

struct Entry {
  std::string name;
  std::uint32_t value;
};

std::string enumeration(const std::string& name, std::uint32_t address, const std::vector<Entry>& entries,
                        const char* access = "RW") {
  std::string text = "<Enumeration Name=\"" + name + "\">";
  for (const Entry& entry : entries) {
    text += "<EnumEntry Name=\"" + entry.name + "\"><Value>" + std::to_string(entry.value) + "</Value></EnumEntry>";
  }
  return text + "<pValue>" + name + "Register</pValue></Enumeration>\n" +
         int_register(name + "Register", address, access);
}

std::string command(const std::string& name, const std::string& on_register, int value) {
  return "<Command Name=\"" + name + "\"><pValue>" + on_register + "</pValue><CommandValue>" + std::to_string(value) +
         "</CommandValue></Command>\n";
}

std::string table_float(const std::string& name, std::uint32_t address) {
  return "<FloatReg Name=\"" + name + "\"><Address>" + hex(address) + "</Address><pIndex Offset=\"" +
         std::to_string(kModeStride) + "\">Scan3dOperatingModeRegister</pIndex><pIndex Offset=\"" +
         std::to_string(kAxisStride) +
         "\">Scan3dCoordinateSelectorRegister</pIndex><Length>8</Length><AccessMode>RO</AccessMode><pPort>Device</"
         "pPort>"
         "<Endianess>BigEndian</Endianess></FloatReg>\n";
}

std::string modes() {
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < kHeliosModes.size(); ++i) entries.push_back({kHeliosModes[i], i});
  return enumeration("Scan3dOperatingMode", kModeRegister, entries);
}

std::string formats(OfferedFormats offered) {
  std::vector<Entry> entries{{"Mono16", host::kMono16}};
  if (offered == OfferedFormats::kGrey) entries.push_back({"Mono8", host::kMono8});
  if (offered != OfferedFormats::kGrey) entries.insert(entries.begin(), {"Coord3D_C16", host::kCoord3dC16});
  if (offered == OfferedFormats::kDepth) entries.insert(entries.begin(), {"Coord3D_ABCY16", host::kCoord3dAbcy16});
  return enumeration("PixelFormat", 0x128, entries);
}

std::string category(const std::string& name, const std::vector<const char*>& features) {
  std::string text = "<Category Name=\"" + name + "\">";
  for (const char* feature : features) text += std::string("<pFeature>") + feature + "</pFeature>";
  return text + "</Category>\n";
}

struct PtpNodeNames {
  const char* enable;
  const char* status;
  const char* latch;
};

PtpNodeNames ptp_node_names(PtpNames names) {
  return names == PtpNames::kOld ? PtpNodeNames{"GevIEEE1588", "GevIEEE1588Status", "GevIEEE1588DataSetLatch"}
                                 : PtpNodeNames{"PtpEnable", "PtpStatus", "PtpDataSetLatch"};
}

std::string ptp(PtpNames names, bool refused) {
  if (names == PtpNames::kNone) return {};
  const PtpNodeNames nodes = ptp_node_names(names);
  const std::string enable = nodes.enable;
  // A value that is computed cannot be written.
  const std::string refusing = "<Boolean Name=\"" + enable + "\"><pValue>" + enable +
                               "Off</pValue></Boolean>\n<IntSwissKnife Name=\"" + enable +
                               "Off\"><Formula>0</Formula></IntSwissKnife>\n";
  return (refused ? refusing : boolean(enable, kPtpEnableRegister)) +
         enumeration(
             nodes.status, kPtpStatusRegister,
             {{"Initializing", 1}, {"Disabled", kPtpDisabled}, {"Listening", kPtpListening}, {"Slave", kPtpSlave}},
             "RO") +
         command(nodes.latch, "PtpLatchRegister", 1) + int_register("PtpLatchRegister", kPtpLatchRegister, "WO");
}

std::string categories(bool depth, PtpNames ptp_names) {
  const PtpNodeNames nodes = ptp_node_names(ptp_names);
  std::vector<const char*> transport{"PayloadSize"};
  if (ptp_names != PtpNames::kNone) transport.insert(transport.end(), {nodes.enable, nodes.status, nodes.latch});
  std::vector<const char*> all{"DeviceControl", "ImageFormatControl", "AcquisitionControl", "TransportLayerControl"};
  if (depth) all.push_back("Scan3dControl");
  const std::string scan3d = category(
      "Scan3dControl", {"Scan3dOperatingMode", "Scan3dCoordinateSelector", "Scan3dCoordinateScale",
                        "Scan3dCoordinateOffset", "Scan3dConfidenceThresholdEnable", "Scan3dConfidenceThresholdMin",
                        "Scan3dSpatialFilterEnable", "Scan3dFlyingPixelsRemovalEnable"});
  return category("Root", all) +
         category("DeviceControl",
                  {"DeviceVendorName", "DeviceModelName", "DeviceVersion", "DeviceSerialNumber", "DeviceID"}) +
         category("ImageFormatControl",
                  {"SensorWidth", "SensorHeight", "OffsetX", "OffsetY", "Width", "Height", "PixelFormat"}) +
         category("AcquisitionControl", {"AcquisitionMode", "AcquisitionStart", "AcquisitionStop",
                                         "AcquisitionFrameRate", "ExposureTimeSelector"}) +
         (depth ? scan3d : std::string()) + category("TransportLayerControl", transport);
}

// Addresses below 0x400 are those of the fake camera's own registers and of GigE Vision's first page.
std::string device_and_image(OfferedFormats offered) {
  return text_register("DeviceVendorName", 0x48, 32) + text_register("DeviceModelName", 0x68, 32) +
         text_register("DeviceVersion", 0x88, 32) + text_register("DeviceSerialNumber", 0xD8, 16) +
         text_register("DeviceID", 0xD8, 16) + integer("SensorHeight", 0x118, "", "RO") +
         integer("SensorWidth", 0x11C, "", "RO") + integer("OffsetX", 0x130, "<Min>0</Min><Max>0</Max>") +
         integer("OffsetY", 0x134, "<Min>0</Min><Max>0</Max>") +
         integer("Width", 0x100, "<Min>1</Min><pMax>SensorWidth</pMax>") +
         integer("Height", 0x104, "<Min>1</Min><pMax>SensorHeight</pMax>") + formats(offered);
}

std::string acquisition() {
  return enumeration("AcquisitionMode", 0x12C, {{"Continuous", 1}, {"SingleFrame", 2}, {"MultiFrame", 3}}) +
         command("AcquisitionStart", "AcquisitionRegister", 1) + command("AcquisitionStop", "AcquisitionRegister", 0) +
         int_register("AcquisitionRegister", 0x124, "WO") +
         "<Float Name=\"AcquisitionFrameRate\"><pValue>FrameRateConverter</pValue></Float>\n"
         "<Converter Name=\"FrameRateConverter\"><FormulaTo>(1000000 / FROM)</FormulaTo><FormulaFrom>(1000000 / TO)"
         "</FormulaFrom><pValue>FramePeriod</pValue></Converter>\n" +
         integer("FramePeriod", 0x138, "<Min>1000</Min><Max>10000000</Max>") +
         enumeration("ExposureTimeSelector", 0x2010, {{"Exp1000Us", 0}, {"Exp250Us", 1}, {"Exp62_5Us", 2}});
}

std::string scan3d() {
  return modes() +
         enumeration("Scan3dCoordinateSelector", kAxisRegister,
                     {{"CoordinateA", 0}, {"CoordinateB", 1}, {"CoordinateC", 2}}) +
         table_float("Scan3dCoordinateScale", kScaleTable) + table_float("Scan3dCoordinateOffset", kOffsetTable) +
         boolean("Scan3dConfidenceThresholdEnable", 0x2014) +
         integer("Scan3dConfidenceThresholdMin", 0x2018, "<Min>0</Min><Max>65535</Max>") +
         boolean("Scan3dSpatialFilterEnable", 0x201C) + boolean("Scan3dFlyingPixelsRemovalEnable", 0x2020);
}

std::string transport() {
  return "<IntSwissKnife Name=\"PayloadSize\"><pVariable Name=\"W\">Width</pVariable><pVariable Name=\"H\">Height"
         "</pVariable><pVariable Name=\"F\">PixelFormat</pVariable><Formula>W * H * ((F &gt;&gt; 16) &amp; 0xFF) / 8"
         "</Formula></IntSwissKnife>\n<Integer Name=\"TLParamsLocked\"><Value>0</Value></Integer>\n" +
         command("TimestampLatch", "TimestampLatchRegister", 1) +
         int_register("TimestampLatchRegister", kClockLatchRegister, "WO") +
         "<IntReg Name=\"TimestampLatchValue\"><Address>" + hex(kClockRegister) +
         "</Address><Length>8</Length><AccessMode>RO</AccessMode><pPort>Device</pPort><Cachable>NoCache</Cachable>"
         "<Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>\n"
         "<Port Name=\"Device\"></Port>\n";
}

}  // namespace

std::string helios_description(OfferedFormats formats, PtpNames ptp_names, bool ptp_refused) {
  const bool depth = formats != OfferedFormats::kGrey;
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<RegisterDescription ModelName=\"Helios\" VendorName=\"LUCID\" "
         "StandardNameSpace=\"None\" SchemaMajorVersion=\"1\" SchemaMinorVersion=\"0\" SchemaSubMinorVersion=\"1\" "
         "MajorVersion=\"1\" MinorVersion=\"0\" SubMinorVersion=\"0\" ToolTip=\"Simulated Helios\" ProductGuid=\"0\" "
         "VersionGuid=\"0\" xmlns=\"http://www.genicam.org/GenApi/Version_1_0\" "
         "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
         "xsi:schemaLocation=\"http://www.genicam.org/GenApi/Version_1_0 GenApiSchema.xsd\">\n" +
         categories(depth, ptp_names) + device_and_image(formats) + acquisition() + (depth ? scan3d() : std::string()) +
         ptp(ptp_names, ptp_refused) + transport() + "</RegisterDescription>\n";
}

}  // namespace pharos::sim
