using System;

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public sealed class MenuItem : Attribute
    {
        public string menuItem;
        public bool validate;
        public int priority;
        public MenuItem(string itemName) : this(itemName, false) { }
        public MenuItem(string itemName, bool isValidateFunction) : this(itemName, isValidateFunction, 1000) { }

        public MenuItem(string itemName, bool isValidateFunction, int priority)
        {
            menuItem = itemName;
            validate = isValidateFunction;
            this.priority = priority;
        }
    }

    [AttributeUsage(AttributeTargets.Class, Inherited = false, AllowMultiple = true)]
    public sealed class CustomPropertyDrawer : Attribute
    {
        internal readonly Type type;
        public CustomPropertyDrawer(Type type) => this.type = type;
    }

    public class CustomEditor : Attribute
    {
        internal readonly Type inspectedType;
        public CustomEditor(Type inspectedType) => this.inspectedType = inspectedType;
    }

    public sealed class CanEditMultipleObjects : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public class InitializeOnLoadMethodAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class SettingsProviderAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Class)]
    public class FilePathAttribute : Attribute
    {
        internal readonly string relativePath;
        public FilePathAttribute(string relativePath, Location location) => this.relativePath = relativePath;

        public enum Location
        {
            PreferencesFolder,
            ProjectFolder,
        }
    }
}
